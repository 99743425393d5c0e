#pragma once

#include "canopeer/config/yaml_reader.h"
#include "canopeer/mission/mission_options.h"

namespace canopeer {

/// The keys `clock` and `frames` of a mission file. `exposure_s`: of the simulated camera, 0: it
/// knows no blur. `planner`: of the one that the mission names.
void read_frames(YamlMap& file, const CameraIntrinsics& camera, double exposure_s,
                 const PlannerManners& planner, MissionOptions& mission);

}  // namespace canopeer
