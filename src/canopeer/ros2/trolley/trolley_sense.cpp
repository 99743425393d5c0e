#include "canopeer/ros2/trolley/trolley_sense.h"

#include <cmath>

#include "canopeer/cdr/messages/std_msgs.h"

namespace canopeer::ros {

TrolleySense::TrolleySense(const RobotModel& robot, const Ros2TrolleySettings& settings,
                           const TrolleyState& start) {
  using Kind = Ros2TrolleySettings::Kind;
  // Who pushes a trolley by hand has often a joint_state_publisher that says zeros.
  const bool joint_states = settings.kind == Kind::trajectory || settings.kind == Kind::topics;
  axes_[0].name = "travel";
  axes_[0].joint = robot.setup().travel_joint;
  axes_[0].topic = settings.travel_state;
  axes_[1].name = "lift";
  axes_[1].joint = robot.setup().lift_joint;
  axes_[1].topic = settings.lift_state;
  for (Axis& axis : axes_) {
    if (axis.joint.empty() || (axis.topic.empty() && !joint_states)) continue;
    axis.history = std::make_unique<JointHistory>(std::vector<std::string>{axis.joint});
  }
  believe(start);
}

Expected<void> TrolleySense::listen(Node& node, const RosClock& clock) {
  for (Axis& axis : axes_) {
    if (axis.history == nullptr || axis.topic.empty()) continue;
    auto subscription = node.subscribe<std_msgs::Float64>(
        axis.topic, Qos{false, false, 10},
        [history = axis.history.get(), &clock](const std_msgs::Float64& said, const Guid&) {
          if (std::isfinite(said.data)) history->add(0, {clock.now(), said.data});
        });
    if (!subscription) return fail_in(axis.topic, subscription.error());
    axis.subscription = std::move(*subscription);
  }
  return {};
}

std::vector<JointHistory*> TrolleySense::by_joint_states() {
  std::vector<JointHistory*> histories;
  for (Axis& axis : axes_) {
    if (axis.history != nullptr && axis.topic.empty()) histories.push_back(axis.history.get());
  }
  return histories;
}

double TrolleySense::Axis::now(double if_unknown) const {
  if (history == nullptr) return if_unknown;
  const auto last = history->last();
  return last ? last->front() : if_unknown;
}

double TrolleySense::Axis::at(Stamp stamp) const {
  if (history == nullptr) return believed;
  if (const auto then = history->at(stamp)) return then->front();
  const auto oldest = history->oldest();
  if (!oldest || stamp >= *oldest) return now(believed);
  const auto first = history->between(0, *oldest, *oldest);
  return first.empty() ? now(believed) : first.front().position;
}

TrolleyState TrolleySense::now() const {
  return now_believing({axes_[0].believed, axes_[1].believed});
}

TrolleyState TrolleySense::now_believing(const TrolleyState& state) const {
  return {axes_[0].now(state.travel_m), axes_[1].now(state.lift_m)};
}

TrolleyState TrolleySense::at(Stamp stamp) const {
  return {axes_[0].at(stamp), axes_[1].at(stamp)};
}

std::optional<Stamp> TrolleySense::known_until() const {
  std::optional<Stamp> known;
  for (const Axis& axis : axes_) {
    if (axis.history == nullptr) continue;
    const auto newest = axis.history->newest();
    if (newest && (!known || *newest < *known)) known = newest;
  }
  return known;
}

void TrolleySense::believe(const TrolleyState& state) {
  axes_[0].believed = state.travel_m;
  axes_[1].believed = state.lift_m;
}

std::vector<std::string> TrolleySense::silent(double seconds) const {
  std::vector<std::string> silent;
  for (const Axis& axis : axes_) {
    if (axis.history == nullptr || axis.history->silence_s() <= seconds) continue;
    silent.push_back(
        axis.name + (axis.topic.empty() ? " (joint " + axis.joint + ")" : " (" + axis.topic + ")"));
  }
  return silent;
}

}  // namespace canopeer::ros
