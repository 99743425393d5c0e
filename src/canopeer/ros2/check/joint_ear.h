#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/dds/node.h"
#include "canopeer/ros2/camera/clock_difference.h"

namespace canopeer::ros {

/// What joint states said, by the driver's names.
struct HeardJoints {
  std::map<std::string, double> positions;  ///< the last of each, rad or m
  /// The last of each by who says it, since it was counted; the first few who do.
  std::map<std::string, std::map<Guid, double>> said_by;
  std::set<std::string> not_finite;     ///< joints whose positions are no numbers
  std::map<std::string, int> messages;  ///< by topic
  int without_stamp = 0;
  std::optional<double> least_age_s;  ///< see ClockDifference
};

/// Listens to joint states as they are, whoever's they are. Thread-safe.
class JointEar {
 public:
  /// `now`: ROS time by our clock.
  explicit JointEar(std::function<Stamp()> now) : now_(std::move(now)) {}
  [[nodiscard]] Expected<void> listen(Node& node, const std::vector<std::string>& topics);
  void take(const std::string& topic, const sensor_msgs::JointState& state, const Guid& writer);
  [[nodiscard]] HeardJoints heard() const;
  /// Forgets how many messages came, and of whom.
  void count_from_now();

 private:
  const std::function<Stamp()> now_;
  mutable std::mutex mutex_;
  HeardJoints heard_;
  ClockDifference age_;
  std::vector<Subscription> subscriptions_;  // last: they stop first
};

}  // namespace canopeer::ros
