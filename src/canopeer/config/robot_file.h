#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// Reads a robot.yaml and the URDF and SRDF it names (relative to it). Errors name file, line and
/// key, what was expected, and the nearest valid key.
[[nodiscard]] Expected<RobotModel> load_robot(const std::filesystem::path& path);

}  // namespace canopeer
