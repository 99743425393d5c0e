#include "canopeer/ros2/robot/joint_voice.h"

#include <algorithm>
#include <limits>

#include "canopeer/ros2/arm/joint_listener.h"

namespace canopeer::ros {

Expected<std::unique_ptr<JointVoice>> JointVoice::make(Node& node, const Ros2ArmSettings& names,
                                                       bool split, const RobotModel& robot,
                                                       const RobotClock& clock,
                                                       const RobotFaults& faults) {
  std::unique_ptr<JointVoice> voice(new JointVoice(robot, clock, faults));
  for (const std::string& joint : robot.setup().arm_joints) {
    voice->arm_names_.push_back(drivers_name(names.joint_names, joint));
  }
  for (const std::string& joint : voice->axes_.joints()) {
    voice->trolley_names_.push_back(drivers_name(names.joint_names, joint));
  }
  if (auto ok = voice->advertise(node, names, split); !ok) return tl::unexpected(ok.error());
  return voice;
}

JointVoice::JointVoice(const RobotModel& robot, const RobotClock& clock, const RobotFaults& faults)
    : clock_(clock), faults_(faults), axes_(robot), frames_(robot) {}

Expected<void> JointVoice::advertise(Node& node, const Ros2ArmSettings& names, bool split) {
  const bool two = split || names.joint_states.size() > 1;
  for (int i = 0; i < (two ? 2 : 1); ++i) {
    const std::string& topic =
        names.joint_states.size() > 1 ? names.joint_states[i] : names.joint_states.front();
    auto publisher = node.advertise<sensor_msgs::JointState>(topic);
    if (!publisher) return tl::unexpected(publisher.error());
    speakers_.push_back({std::move(*publisher), !two || i == 0, !two || i == 1});
  }
  auto nonsense =
      node.dds_writer("rt" + node.resolve(names.joint_states.front()),
                      dds_type<sensor_msgs::JointState>(), kDefaultQos, "source=canopeer;");
  auto tf = node.advertise<tf2_msgs::TFMessage>("/tf", kTfQos);
  auto tf_static = node.advertise<tf2_msgs::TFMessage>("/tf_static", kLatchedQos);
  if (!nonsense) return tl::unexpected(nonsense.error());
  if (!tf) return tl::unexpected(tf.error());
  if (!tf_static) return tl::unexpected(tf_static.error());
  nonsense_ = std::move(*nonsense);
  tf_ = std::move(*tf);
  tf_static_ = std::move(*tf_static);
  tf_static_.publish(frames_.fixed(stamp_of(clock_.said(clock_.now()))));
  if (clock_.simulated()) {
    auto time = node.advertise<rosgraph_msgs::Clock>("/clock");
    if (!time) return tl::unexpected(time.error());
    time_ = std::move(*time);
  }
  return {};
}

void JointVoice::say(Stamp time, const JointsState& arm, const JointsState& trolley, bool with_tf) {
  const builtin_interfaces::Time stamp = clock_.said(time);
  if (clock_.simulated()) time_.publish({stamp});
  if (faults_.on(RobotFault::malformed)) say_nonsense();
  if (faults_.on(RobotFault::joint_states_silent)) return;
  say_joints(stamp, arm, trolley);
  if (with_tf && tf_.readers() > 0) {
    tf_.publish(frames_.moving(arm.position, axes_.state(trolley.position), stamp_of(stamp)));
  }
}

void JointVoice::say_joints(const builtin_interfaces::Time& stamp, const JointsState& arm,
                            const JointsState& trolley) {
  for (const Speaker& speaker : speakers_) {
    std::vector<Named> joints;
    const auto add = [&](const std::vector<std::string>& names, const JointsState& state) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        joints.push_back({names[i], state.position[k], state.velocity[k]});
      }
    };
    if (speaker.arm) add(arm_names_, arm);
    if (speaker.arm) joints.push_back({"gripper_finger_joint", 0.02, 0.0});
    if (speaker.trolley) add(trolley_names_, trolley);
    std::sort(joints.begin(), joints.end(),
              [](const Named& a, const Named& b) { return a.name < b.name; });
    sensor_msgs::JointState message;
    message.header.stamp = stamp;
    const std::string before = faults_.on(RobotFault::wrong_names) ? "other_" : "";
    for (const Named& joint : joints) {
      message.name.push_back(before + joint.name);
      message.position.push_back(joint.position);
      message.velocity.push_back(joint.velocity);
      message.effort.push_back(0.0);
    }
    if (faults_.on(RobotFault::nan_positions)) {
      message.position.front() = std::numeric_limits<double>::quiet_NaN();
    }
    speaker.publisher.publish(message);
  }
}

/// Cut short, a count of four thousand million, no CDR at all.
void JointVoice::say_nonsense() {
  static_cast<void>(nonsense_->write(Payload{0, 1, 0, 0, 1, 2}));
  static_cast<void>(nonsense_->write(
      Payload{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255}));
  static_cast<void>(nonsense_->write(Payload{77, 77, 77, 77, 77, 77, 77, 77}));
}

}  // namespace canopeer::ros
