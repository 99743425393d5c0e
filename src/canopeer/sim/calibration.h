#pragma once

#include <functional>
#include <string_view>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/detector_registry.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/simulation.h"

namespace canopeer {

/// Measures what each kind of work costs on this machine: seconds of CPU time per unit on one
/// thread, the best of several repetitions, on frames, graphs and searches of the first segment of
/// `mission` in `scene`. Takes some seconds. Not deterministic: it is a measurement.
///
/// `robot`, `ik` and `scene` as for a run; `detectors` makes the mission's, without errors;
/// `progress` is told the kind about to be measured.
[[nodiscard]] CostTable measure_costs(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                                      const MissionOptions& mission,
                                      const DetectorRegistry& detectors,
                                      const SimulationOptions& simulation,
                                      const std::function<void(std::string_view)>& progress);

}  // namespace canopeer
