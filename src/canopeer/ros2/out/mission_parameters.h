#pragma once

#include <string>
#include <vector>

#include "canopeer/dds/parameters.h"

namespace canopeer::ros {

/// Every setting of a mission as a parameter of the node, read-only: `settings_json` is
/// MissionFile's. The site's own have the names that `--ros-args -p` takes ("arm.speed_scale" for
/// the key ros2.arm.speed_scale), all others "mission." before theirs ("mission.planner"). Lists of
/// numbers, truths or texts are arrays; what is neither is JSON in text. Those of `live` take the
/// place of settings of the same name.
[[nodiscard]] std::vector<ParameterAccess> mission_parameters(const std::string& settings_json,
                                                              std::vector<ParameterAccess> live);

}  // namespace canopeer::ros
