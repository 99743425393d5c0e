#pragma once

#include <filesystem>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Reads a robot's links, joints and collision shapes from a URDF file. A continuous joint has no
/// limits here. Acceleration limits and disabled pairs are not in a URDF. Errors (malformed XML,
/// xacro that needs expanding, mesh shapes, mimic joints, no single tree) name file and line.
[[nodiscard]] Expected<RobotDescription> read_urdf(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Expected<RobotDescription> parse_urdf(const std::string& xml,
                                                    const std::string& name);

}  // namespace canopeer
