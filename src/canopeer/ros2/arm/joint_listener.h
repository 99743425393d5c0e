#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"
#include "canopeer/ros2/time/joint_history.h"

namespace canopeer::ros {

/// Hears joint states: by name, in any order, from several publishers, each of some of the joints.
/// What it does not know is passed over. Thread-safe.
class JointListener {
 public:
  struct Counts {
    std::int64_t messages = 0;
    std::int64_t not_finite = 0;  ///< positions that are no numbers: refused
    std::int64_t malformed = 0;   ///< messages with fewer positions than names: refused
    std::int64_t late = 0;        ///< positions older than what was known
    std::int64_t jumps_back = 0;  ///< of a joint's stamps
  };

  /// `names`: URDF to driver's, where they differ. `now`: for stamps that are 0. `histories`: what
  /// is told of the joints in them; they outlive the listener.
  JointListener(const std::map<std::string, std::string>& names,
                std::vector<JointHistory*> histories, std::function<Stamp()> now);

  /// Subscribes; the error names the topic. `node` outlives the listener.
  [[nodiscard]] Expected<void> listen(Node& node, const std::vector<std::string>& topics);

  void take(const sensor_msgs::JointState& state,
            JointHistory::Steady::time_point received = JointHistory::Steady::now());

  [[nodiscard]] Counts counts() const;
  /// Names heard that nobody wanted, for people who look for a joint; the first hundred.
  [[nodiscard]] std::set<std::string> strangers() const;

 private:
  struct Place {
    JointHistory* history;
    int joint;
  };
  const std::function<Stamp()> now_;
  std::map<std::string, Place> places_;  ///< by driver's name; fixed
  mutable std::mutex mutex_;             // of what follows
  Counts counts_;
  std::set<std::string> strangers_;
  std::vector<Subscription> subscriptions_;  // last: their callbacks use all above
};

/// A joint of the URDF as the driver calls it.
[[nodiscard]] std::string drivers_name(const std::map<std::string, std::string>& names,
                                       const std::string& joint);

}  // namespace canopeer::ros
