#pragma once

#include <vector>

#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"
#include "canopeer/ros2/robot/robot_axes.h"
#include "canopeer/ros2/robot/trajectory_server.h"

namespace canopeer::ros {

/// A trolley that is told by numbers where to go: by topics of the settings (`topics`), and by
/// `~/push_trolley` (std_msgs/Float64MultiArray: travel and lift, m), which is the person who
/// pushes one that nothing drives.
class TrolleyTopics {
 public:
  /// What is referred to outlives the topics.
  [[nodiscard]] static Expected<std::unique_ptr<TrolleyTopics>> make(
      Node& node, const Ros2TrolleySettings& names, const RobotModel& robot,
      TrajectoryServer& trolley);
  /// Says where the axes are.
  void say();

 private:
  TrolleyTopics(const RobotModel& robot, TrajectoryServer& trolley);
  [[nodiscard]] Expected<void> join(Node& node, const Ros2TrolleySettings& names);
  void go_to(const TrolleyState& goal);

  const RobotModel& robot_;
  TrolleyAxes axes_;
  TrajectoryServer& trolley_;
  std::mutex mutex_;
  TrolleyState goal_;
  Publisher<std_msgs::Float64> travel_;
  Publisher<std_msgs::Float64> lift_;
  std::vector<Subscription> heard_;  // last: silent before the rest goes
};

}  // namespace canopeer::ros
