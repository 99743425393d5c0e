#pragma once

#include <string>
#include <vector>

#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/out/others_frames.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// Where the robot is.
struct RobotPlace {
  Configuration q;
  TrolleyState trolley;
};

/// What has to be told so that all hangs together under `map_frame`, which is the world: the links
/// that nobody else tells, and above the tree of others where `map_frame` is. Nothing is told a
/// second time.
[[nodiscard]] std::vector<geometry_msgs::TransformStamped> missing_frames(
    const RobotModel& robot, const RobotPlace& place, const std::string& map_frame,
    const OthersFrames::Frames& others, Stamp stamp);

}  // namespace canopeer::ros
