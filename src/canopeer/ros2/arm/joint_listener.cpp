#include "canopeer/ros2/arm/joint_listener.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "canopeer/dds/names.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr std::size_t kMostStrangers = 100;
constexpr double kAside_s = 0.5;  // either of two publishers may lag by so much
constexpr std::chrono::milliseconds kAside(500);
constexpr std::chrono::milliseconds kStillWrong(2000);  // since it was said

/// As `ros2 topic info --verbose` shows it.
std::string gid(const Guid& guid) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t octet : guid) {
    if (!text.empty()) text += '.';
    text += {kDigits[octet >> 4], kDigits[octet & 15]};
  }
  return text;
}

}  // namespace

std::string drivers_name(const std::map<std::string, std::string>& names,
                         const std::string& joint) {
  const auto found = names.find(joint);
  return found == names.end() ? joint : found->second;
}

JointListener::JointListener(const std::map<std::string, std::string>& names,
                             std::vector<JointHistory*> histories, std::function<Stamp()> now,
                             double tolerance)
    : now_(std::move(now)), tolerance_(tolerance) {
  for (JointHistory* const history : histories) {
    for (std::size_t i = 0; i < history->joints().size(); ++i) {
      Place& place = places_[drivers_name(names, history->joints()[i])];
      place.history = history;
      place.joint = static_cast<int>(i);
    }
  }
}

Expected<void> JointListener::listen(Node& node, const std::vector<std::string>& topics) {
  // Best effort hears those who publish reliably too.
  const Qos qos{false, false, 50};
  for (const std::string& topic : topics) {
    auto subscription = node.subscribe<sensor_msgs::JointState>(
        topic, qos, [this](const sensor_msgs::JointState& state, const Guid& writer) {
          take(state, Steady::now(), writer);
        });
    if (!subscription) return fail_in(topic, subscription.error());
    subscriptions_.push_back(std::move(*subscription));
  }
  return {};
}

void JointListener::take(const sensor_msgs::JointState& state, Steady::time_point received,
                         const Guid& writer) {
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
      if (strangers_.size() < kMostStrangers && is_short_name(state.name[i])) {
        strangers_.insert(state.name[i]);
      }
      continue;
    }
    if (!std::isfinite(state.position[i])) {
      ++counts_.not_finite;
      continue;
    }
    if (!believed(place->second, writer, state.position[i], received)) continue;
    place->second.stamp = stamp;
    const auto added =
        place->second.history->add(place->second.joint, {stamp, state.position[i]}, received);
    if (added == JointHistory::Added::late) ++counts_.late;
    if (added == JointHistory::Added::jumped_back) ++counts_.jumps_back;
  }
}

bool JointListener::believed(Place& place, const Guid& writer, double position,
                             Steady::time_point received) const {
  if (place.other && received - place.other->received > kAside) judge(place);
  if (writer == place.believed || received - place.heard > kAside) {
    place.believed = writer;
    place.heard = received;
    return true;
  }
  if (!place.other) place.other = Other{writer, position, place.stamp, received};
  return false;
}

/// Right is what the one who is believed said a little before, or says a little later.
void JointListener::judge(Place& place) const {
  const Other other = *std::exchange(place.other, std::nullopt);
  const auto said = place.history->between(place.joint, other.at - nanoseconds(kAside_s),
                                           other.at + nanoseconds(kAside_s));
  if (said.empty()) return;
  double low = said.front().position;
  double high = low;
  for (const auto& sample : said) {
    low = std::min(low, sample.position);
    high = std::max(high, sample.position);
  }
  place.instead = std::clamp(other.position, low, high);
  place.wrong.reset();
  if (std::abs(other.position - place.instead) > tolerance_) place.wrong = other;
}

std::optional<std::string> JointListener::contradiction(Steady::time_point now) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, place] : places_) {
    if (!place.wrong || now - place.wrong->received > kStillWrong) continue;
    return "two publishers contradict each other: " + name + " is at " + figure(place.instead, 3) +
           " by " + gid(place.believed) + ", at " + figure(place.wrong->position, 3) + " by " +
           gid(place.wrong->writer) +
           "; stop one of them (ros2 topic info --verbose names their nodes)";
  }
  return std::nullopt;
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
