#pragma once

#include <string>
#include <vector>

#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// Each link of the robot in the one that carries it, and its root in `world_frame`.
[[nodiscard]] std::vector<geometry_msgs::TransformStamped> link_transforms(
    const RobotModel& robot, const Configuration& q, const TrolleyState& trolley,
    const std::string& world_frame, Stamp stamp);

}  // namespace canopeer::ros
