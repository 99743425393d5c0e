#pragma once

#include "canopeer/detect/detector_registry.h"
#include "canopeer/planner/registry.h"

namespace canopeer {

/// What a mission may name: planners and detectors.
struct Registries {
  PlannerRegistry planners;
  DetectorRegistry detectors;

  /// Those of this library; add your own.
  [[nodiscard]] static Registries built_in() {
    return {PlannerRegistry::built_in(), DetectorRegistry::built_in()};
  }
};

}  // namespace canopeer
