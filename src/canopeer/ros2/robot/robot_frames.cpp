#include "canopeer/ros2/robot/robot_frames.h"

#include "canopeer/ros2/out/link_transforms.h"

namespace canopeer::ros {

RobotFrames::RobotFrames(const RobotModel& robot) : robot_(robot) {
  for (const Joint& joint : robot.description().joints) {
    if (joint.type != JointType::kFixed) moving_.insert(joint.child);
  }
}

tf2_msgs::TFMessage RobotFrames::fixed(Stamp stamp) const {
  tf2_msgs::TFMessage message{
      link_transforms(robot_, Configuration::Zero(robot_.dof()), {}, "world", stamp)};
  std::erase_if(message.transforms,
                [&](const auto& t) { return moving_.count(t.child_frame_id) > 0; });
  return message;
}

tf2_msgs::TFMessage RobotFrames::moving(const Configuration& q, const TrolleyState& trolley,
                                        Stamp stamp) const {
  tf2_msgs::TFMessage message{link_transforms(robot_, q, trolley, "world", stamp)};
  std::erase_if(message.transforms,
                [&](const auto& t) { return moving_.count(t.child_frame_id) == 0; });
  return message;
}

}  // namespace canopeer::ros
