#include "canopeer/ros2/check/joint_ear.h"

#include <algorithm>
#include <cmath>

#include "canopeer/dds/names.h"

namespace canopeer::ros {

Expected<void> JointEar::listen(Node& node, const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) {
    auto made = node.subscribe<sensor_msgs::JointState>(
        topic, kSensorQos, [this, topic](sensor_msgs::JointState&& state, const Guid& writer) {
          take(topic, state, writer);
        });
    if (!made) return tl::unexpected(made.error());
    subscriptions_.push_back(std::move(*made));
  }
  return {};
}

void JointEar::take(const std::string& topic, const sensor_msgs::JointState& state,
                    const Guid& writer) {
  constexpr std::size_t kMostJoints = 1000;
  constexpr std::size_t kMostWriters = 8;
  const std::lock_guard lock(mutex_);
  ++heard_.messages[topic];
  const Stamp stamp = stamp_of(state.header.stamp);
  heard_.without_stamp += stamp <= 0;
  if (stamp > 0) age_.add(now_() - stamp);
  const std::size_t count = std::min(state.name.size(), state.position.size());
  for (std::size_t i = 0; i < count && heard_.positions.size() < kMostJoints; ++i) {
    if (!is_short_name(state.name[i])) continue;
    heard_.positions[state.name[i]] = state.position[i];
    if (!std::isfinite(state.position[i])) {
      heard_.not_finite.insert(state.name[i]);
      continue;
    }
    auto& said = heard_.said_by[state.name[i]];
    if (said.size() < kMostWriters || said.contains(writer)) said[writer] = state.position[i];
  }
}

HeardJoints JointEar::heard() const {
  const std::lock_guard lock(mutex_);
  HeardJoints heard = heard_;
  heard.least_age_s = age_.least_age_s();
  return heard;
}

void JointEar::count_from_now() {
  const std::lock_guard lock(mutex_);
  heard_.messages.clear();
  heard_.said_by.clear();
  heard_.without_stamp = 0;
}

}  // namespace canopeer::ros
