#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"
#include "canopeer/ros2/time/joint_history.h"

namespace canopeer::ros {

/// Hears joint states: by name, in any order, from several publishers, each of some of the joints.
/// Of those who tell the same joint the first is believed, as long as it is heard; the others are
/// held against it. What it does not know is passed over. Thread-safe.
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
  /// is told of the joints in them; they outlive the listener. `tolerance`, rad (m): publishers who
  /// differ by more contradict each other.
  JointListener(const std::map<std::string, std::string>& names,
                std::vector<JointHistory*> histories, std::function<Stamp()> now,
                double tolerance = 0.02);

  /// Subscribes; the error names the topic. `node` outlives the listener.
  [[nodiscard]] Expected<void> listen(Node& node, const std::vector<std::string>& topics);

  using Steady = JointHistory::Steady;
  void take(const sensor_msgs::JointState& state, Steady::time_point received = Steady::now(),
            const Guid& writer = {});

  [[nodiscard]] Counts counts() const;
  /// Two living publishers who say that a joint is in different places, for people; nothing: there
  /// are none. Known half a second after they said it.
  [[nodiscard]] std::optional<std::string> contradiction(
      Steady::time_point now = Steady::now()) const;
  /// Names heard that nobody wanted, for people who look for a joint; the first hundred.
  [[nodiscard]] std::set<std::string> strangers() const;

 private:
  /// What somebody else than the one who is believed said.
  struct Other {
    Guid writer{};
    double position = 0.0;
    Stamp at = 0;  ///< the last stamp of who is believed
    Steady::time_point received;
  };
  struct Place {
    JointHistory* history;
    int joint;
    Guid believed{};
    Steady::time_point heard{};  ///< the one who is believed
    Stamp stamp = 0;             ///< of what it said
    std::optional<Other> other;  ///< not judged yet
    std::optional<Other> wrong;  ///< the last that contradicts
    double instead = 0.0;        ///< what the one who is believed said nearest to that
  };
  [[nodiscard]] bool believed(Place& place, const Guid& writer, double position,
                              Steady::time_point received) const;
  void judge(Place& place) const;

  const std::function<Stamp()> now_;
  const double tolerance_;
  mutable std::mutex mutex_;             // of what follows
  std::map<std::string, Place> places_;  ///< by driver's name; the names are fixed
  Counts counts_;
  std::set<std::string> strangers_;
  std::vector<Subscription> subscriptions_;  // last: their callbacks use all above
};

/// A joint of the URDF as the driver calls it.
[[nodiscard]] std::string drivers_name(const std::map<std::string, std::string>& names,
                                       const std::string& joint);

}  // namespace canopeer::ros
