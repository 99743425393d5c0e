#pragma once

#include <filesystem>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Adds the `<disable_collisions>` pairs of an SRDF file to `robot`; the links must be in it. Other
/// elements (groups, states) are left alone: robot.yaml says what they would. Errors name file and
/// line.
[[nodiscard]] Expected<void> read_srdf(const std::filesystem::path& path, RobotDescription& robot);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Expected<void> parse_srdf(const std::string& xml, const std::string& name,
                                        RobotDescription& robot);

}  // namespace canopeer
