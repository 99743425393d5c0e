#pragma once

#include <filesystem>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Adds to `robot` the pairs of links that an SRDF file says need no check, as MoveIt reads it:
/// `<disable_collisions>`, and `<disable_default_collisions>` but for `<enable_collisions>`. Links
/// that the robot has not, and an SRDF of another robot (its name, or most of its links), become
/// notices. Other elements (groups, states) are left alone: robot.yaml says what they would. Errors
/// name file and line.
[[nodiscard]] Expected<void> read_srdf(const std::filesystem::path& path, RobotDescription& robot);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Expected<void> parse_srdf(const std::string& xml, const std::string& name,
                                        RobotDescription& robot);

}  // namespace canopeer
