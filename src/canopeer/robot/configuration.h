#pragma once

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// Most joints an arm may have, linear axes that move with it included.
inline constexpr int kMaxArmJoints = 10;

/// Arm joint positions in the order of RobotSetup::arm_joints: rad, m for a prismatic joint. Its
/// numbers lie inside the object, so that copies allocate nothing.
using Configuration = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxArmJoints, 1>;

}  // namespace canopeer
