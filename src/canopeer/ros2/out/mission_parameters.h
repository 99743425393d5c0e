#pragma once

#include <string>
#include <vector>

#include "canopeer/dds/parameters.h"

namespace canopeer::ros {

/// Every setting of a mission as a parameter of the node, read-only: `settings_json` is
/// MissionFile's, names are those of its keys ("ros2.arm.speed_scale"). Lists of numbers, truths or
/// texts are arrays; what is neither is JSON in text. Those of `live` take the place of settings of
/// the same name.
[[nodiscard]] std::vector<ParameterAccess> mission_parameters(const std::string& settings_json,
                                                              std::vector<ParameterAccess> live);

}  // namespace canopeer::ros
