#include "canopeer/ros2/arm/joint_listener.h"

#include <cmath>

namespace canopeer::ros {
namespace {

constexpr std::size_t kMostStrangers = 100;

}  // namespace

std::string drivers_name(const std::map<std::string, std::string>& names,
                         const std::string& joint) {
  const auto found = names.find(joint);
  return found == names.end() ? joint : found->second;
}

JointListener::JointListener(const std::map<std::string, std::string>& names,
                             std::vector<JointHistory*> histories, std::function<Stamp()> now)
    : now_(std::move(now)) {
  for (JointHistory* const history : histories) {
    for (std::size_t i = 0; i < history->joints().size(); ++i) {
      places_[drivers_name(names, history->joints()[i])] = {history, static_cast<int>(i)};
    }
  }
}

Expected<void> JointListener::listen(Node& node, const std::vector<std::string>& topics) {
  // Best effort hears those who publish reliably too.
  const Qos qos{false, false, 50};
  for (const std::string& topic : topics) {
    auto subscription = node.subscribe<sensor_msgs::JointState>(
        topic, qos, [this](const sensor_msgs::JointState& state, const Guid&) { take(state); });
    if (!subscription) return fail_in(topic, subscription.error());
    subscriptions_.push_back(std::move(*subscription));
  }
  return {};
}

void JointListener::take(const sensor_msgs::JointState& state,
                         JointHistory::Steady::time_point received) {
  const std::lock_guard lock(mutex_);
  ++counts_.messages;
  if (state.position.size() < state.name.size()) {
    ++counts_.malformed;
    return;
  }
  // Some drivers leave the stamp out.
  const Stamp said = stamp_of(state.header.stamp);
  const Stamp stamp = said == 0 ? now_() : said;
  for (std::size_t i = 0; i < state.name.size(); ++i) {
    const auto place = places_.find(state.name[i]);
    if (place == places_.end()) {
      if (strangers_.size() < kMostStrangers) strangers_.insert(state.name[i]);
      continue;
    }
    if (!std::isfinite(state.position[i])) {
      ++counts_.not_finite;
      continue;
    }
    const auto added =
        place->second.history->add(place->second.joint, {stamp, state.position[i]}, received);
    if (added == JointHistory::Added::late) ++counts_.late;
    if (added == JointHistory::Added::jumped_back) ++counts_.jumps_back;
  }
}

JointListener::Counts JointListener::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::set<std::string> JointListener::strangers() const {
  const std::lock_guard lock(mutex_);
  return strangers_;
}

}  // namespace canopeer::ros
