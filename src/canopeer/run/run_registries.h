#pragma once

#include "canopeer/mission/registries.h"
#include "canopeer/run/site.h"
#include "canopeer/sim/truth_planners.h"

namespace canopeer {

/// All that a run may name: planners, detectors, sites.
struct RunRegistries : Registries {
  SiteRegistry sites = SiteRegistry::built_in();

  /// Those of this library, with the planners that know the truth; add your own.
  [[nodiscard]] static RunRegistries built_in() {
    RunRegistries all{Registries::built_in()};
    add_truth_planners(all.planners);
    return all;
  }
};

}  // namespace canopeer
