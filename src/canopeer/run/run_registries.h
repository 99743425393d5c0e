#pragma once

#include "canopeer/mission/registries.h"
#include "canopeer/run/site.h"

namespace canopeer {

/// All that a run may name: planners, detectors, sites.
struct RunRegistries : Registries {
  SiteRegistry sites = SiteRegistry::built_in();

  /// Those of this library; add your own.
  [[nodiscard]] static RunRegistries built_in() { return {Registries::built_in()}; }
};

}  // namespace canopeer
