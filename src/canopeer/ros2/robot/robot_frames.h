#pragma once

#include <set>
#include <string>

#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// The tree of frames of a robot, as robot_state_publisher gives it: from its root link on, and
/// "world" above.
class RobotFrames {
 public:
  /// The robot outlives the frames.
  explicit RobotFrames(const RobotModel& robot);

  /// Frames that never move against their parents; for /tf_static.
  [[nodiscard]] tf2_msgs::TFMessage fixed(Stamp stamp) const;
  /// The others; for /tf.
  [[nodiscard]] tf2_msgs::TFMessage moving(const Configuration& q, const TrolleyState& trolley,
                                           Stamp stamp) const;

 private:
  const RobotModel& robot_;
  std::set<std::string> moving_;  ///< links
};

}  // namespace canopeer::ros
