#pragma once

#include "canopeer/cdr/messages/tf2_msgs.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer::ros {

/// The tree of frames of a robot, as robot_state_publisher gives it: from its root link on, and
/// "world" above.
class RobotFrames {
 public:
  /// The robot outlives the frames.
  explicit RobotFrames(const RobotModel& robot);

  /// Frames that never move against their parents; for /tf_static.
  [[nodiscard]] tf2_msgs::TFMessage fixed(const builtin_interfaces::Time& stamp) const;
  /// The others; for /tf.
  [[nodiscard]] tf2_msgs::TFMessage moving(const Configuration& q, const TrolleyState& trolley,
                                           const builtin_interfaces::Time& stamp) const;

 private:
  struct Frame {
    int parent;  ///< link
    int link;
  };
  const RobotModel& robot_;
  std::vector<Frame> fixed_;
  std::vector<Frame> moving_;
  std::string root_;
};

}  // namespace canopeer::ros
