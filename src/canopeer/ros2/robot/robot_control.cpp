#include "canopeer/ros2/robot/robot_control.h"

#include <sys/resource.h>
#include <unistd.h>

#include "canopeer/ros2/arm/joint_listener.h"

namespace canopeer::ros {
namespace {

constexpr const char* kTrolleyAction = "/trolley_controller/follow_joint_trajectory";
constexpr int kFeedbackEvery = 5;  // ticks
constexpr int kFramesEvery = 3;    // tf
constexpr int kScalingEvery = 25;

std::vector<std::string> driver_names(const Ros2Settings& names,
                                      const std::vector<std::string>& joints) {
  std::vector<std::string> said;
  for (const std::string& joint : joints)
    said.push_back(drivers_name(names.arm.joint_names, joint));
  return said;
}

TrajectoryController arm_controller(const RobotControl::Parts& parts, const Ros2Settings& names,
                                    const Configuration& q) {
  ControllerOptions options;
  options.joints = driver_names(names, parts.robot.setup().arm_joints);
  options.lower = parts.robot.limits().lower;
  options.upper = parts.robot.limits().upper;
  return {std::move(options), q, &parts.faults};
}

TrajectoryController trolley_controller(const Ros2Settings& names, const TrolleyAxes& axes,
                                        const TrolleyState& place) {
  ControllerOptions options;
  options.joints = driver_names(names, axes.joints());
  options.lower = axes.lower();
  options.upper = axes.upper();
  options.goal_tolerance = 0.005;
  return {std::move(options), axes.positions(place)};
}

/// Where that is allowed, control comes before all else, as on real robots.
void come_first() {
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), -15));
}

}  // namespace

Expected<std::unique_ptr<RobotControl>> RobotControl::start(const Parts& parts,
                                                            const Ros2Settings& names,
                                                            const SimulatedPlace& place,
                                                            double rate_hz, bool split) {
  std::unique_ptr<RobotControl> control(new RobotControl(parts, names, place));
  if (auto ok = control->join(names, split); !ok) return tl::unexpected(ok.error());
  control->worker_ = std::jthread(
      [c = control.get(), rate_hz](const std::stop_token& stop) { c->work(rate_hz, stop); });
  return control;
}

RobotControl::RobotControl(const Parts& parts, const Ros2Settings& names,
                           const SimulatedPlace& place)
    : parts_(parts),
      axes_(parts.robot),
      arm_(arm_controller(parts, names, place.q), parts.faults, true) {
  if (axes_.none()) return;
  trolley_ = std::make_unique<TrajectoryServer>(trolley_controller(names, axes_, place.trolley),
                                                parts.faults, false);
}

Expected<void> RobotControl::join(const Ros2Settings& names, bool split) {
  auto voice =
      JointVoice::make(parts_.node, names.arm, split, parts_.robot, parts_.clock, parts_.faults);
  if (!voice) return tl::unexpected(voice.error());
  voice_ = std::move(*voice);
  auto scaling =
      parts_.node.advertise<std_msgs::Float64>("/speed_scaling_state_broadcaster/speed_scaling");
  if (!scaling) return tl::unexpected(scaling.error());
  speed_scaling_ = std::move(*scaling);
  if (!names.arm.safety_mode.empty()) {
    auto mode =
        parts_.node.advertise<ur_dashboard_msgs::SafetyMode>(names.arm.safety_mode, kLatchedQos);
    if (!mode) return tl::unexpected(mode.error());
    safety_mode_ = std::move(*mode);
  }
  if (auto ok = arm_.serve(parts_.node, names.arm.action); !ok) return ok;
  if (trolley_ == nullptr) return {};
  const std::string& action = names.trolley.action;
  if (auto ok = trolley_->serve(parts_.node, action.empty() ? kTrolleyAction : action); !ok) {
    return ok;
  }
  auto topics = TrolleyTopics::make(parts_.node, names.trolley, parts_.robot, *trolley_);
  if (!topics) return tl::unexpected(topics.error());
  trolley_topics_ = std::move(*topics);
  return {};
}

void RobotControl::work(double rate_hz, const std::stop_token& stop) {
  come_first();
  const std::chrono::nanoseconds period(nanoseconds(1.0 / rate_hz));
  auto next = std::chrono::steady_clock::now();
  Stamp before = parts_.clock.now();
  for (std::int64_t number = 0; !stop.stop_requested(); ++number) {
    next = std::max(next + period, std::chrono::steady_clock::now());
    std::this_thread::sleep_until(next);
    const Stamp now = parts_.clock.now();
    if (now <= before) continue;  // the wall's clock was put back
    longest_gap_s_ = std::max(longest_gap_s_.load(), seconds(now - before));
    if (!parts_.faults.on(RobotFault::vanish)) tick(now, seconds(now - before), number);
    before = now;
  }
}

void RobotControl::say_safety_mode() {
  using ur_dashboard_msgs::SafetyMode;
  const std::uint8_t mode = arm_.stopped() ? SafetyMode::PROTECTIVE_STOP : SafetyMode::NORMAL;
  if (mode == said_mode_) return;
  safety_mode_.publish({mode});
  said_mode_ = mode;
}

void RobotControl::tick(Stamp now, double dt_s, std::int64_t number) {
  const builtin_interfaces::Time stamp = parts_.clock.said(now);
  const bool with_feedback = number % kFeedbackEvery == 0;
  arm_.tick(dt_s, with_feedback, stamp);
  const JointsState arm = arm_.actual();
  JointsState trolley{Configuration(0), Configuration(0)};
  if (trolley_ != nullptr) {
    trolley_->tick(dt_s, with_feedback, stamp);
    trolley = trolley_->actual();
  }
  const SimulatedPlace place{arm.position, axes_.state(trolley.position)};
  parts_.history.add(now, place);
  parts_.watch.see(place, !arm_.moving());
  say_safety_mode();
  voice_->say(now, arm, trolley, number % kFramesEvery == 0);
  if (trolley_topics_ != nullptr && with_feedback) trolley_topics_->say();
  if (number % kScalingEvery == 0) speed_scaling_.publish({100.0 * arm_.speed_scale()});
}

}  // namespace canopeer::ros
