#pragma once

#include <memory>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/rosgraph_msgs.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"
#include "canopeer/ros2/robot/robot_axes.h"
#include "canopeer/ros2/robot/robot_clock.h"
#include "canopeer/ros2/robot/robot_frames.h"
#include "canopeer/ros2/robot/trajectory_controller.h"

namespace canopeer::ros {

/// What a robot says of its joints: joint states, tf and tf_static, and the time where that is its
/// own. Joints are sorted by name, and there is one of a gripper that no mission knows. Used by one
/// thread.
class JointVoice {
 public:
  /// `split`: arm and trolley are said by two publishers. What is referred to outlives the voice.
  [[nodiscard]] static Expected<std::unique_ptr<JointVoice>> make(
      Node& node, const Ros2ArmSettings& names, bool split, const RobotModel& robot,
      const RobotClock& clock, const RobotFaults& faults);

  /// Where the joints are at `time`; `trolley` has one entry for each axis.
  void say(Stamp time, const JointsState& arm, const JointsState& trolley, bool with_tf);

 private:
  JointVoice(const RobotModel& robot, const RobotClock& clock, const RobotFaults& faults);
  [[nodiscard]] Expected<void> advertise(Node& node, const Ros2ArmSettings& names, bool split);
  void say_joints(const builtin_interfaces::Time& stamp, const JointsState& arm,
                  const JointsState& trolley);
  void say_nonsense();

  struct Named {
    std::string name;
    double position;
    double velocity;
  };
  struct Speaker {
    Publisher<sensor_msgs::JointState> publisher;
    bool arm = true;
    bool trolley = true;
  };
  const RobotClock& clock_;
  const RobotFaults& faults_;
  TrolleyAxes axes_;
  RobotFrames frames_;
  std::vector<std::string> arm_names_;
  std::vector<std::string> trolley_names_;
  std::vector<Speaker> speakers_;
  std::shared_ptr<Writer> nonsense_;
  Publisher<tf2_msgs::TFMessage> tf_;
  Publisher<tf2_msgs::TFMessage> tf_static_;
  Publisher<rosgraph_msgs::Clock> time_;
};

}  // namespace canopeer::ros
