#pragma once

#include <string>
#include <vector>

#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// What to say of links that move with the arm, can be seen (have a visual shape), and cannot be
/// checked for contact, because they have no collision shape. Empty: nothing.
[[nodiscard]] std::string links_without_shapes(const RobotDescription& robot,
                                               const std::vector<std::string>& arm_joints);

}  // namespace canopeer
