#pragma once

#include <chrono>

#include "canopeer/cdr/messages/builtin_interfaces.h"
#include "canopeer/ros2/robot/robot_faults.h"

namespace canopeer::ros {

using Nanoseconds = std::chrono::nanoseconds;

/// The robot's time: the wall's since 1970, or one of its own that began when it was made. Safe to
/// use from several threads.
class RobotClock {
 public:
  /// `rate`: how fast a simulated clock runs, against the wall's. `faults` outlive the clock.
  RobotClock(bool simulated, double rate, const RobotFaults& faults);

  /// The time by which things happen.
  [[nodiscard]] Nanoseconds now() const;
  [[nodiscard]] bool simulated() const { return simulated_; }
  /// How long to wait on the wall's clock until so much time has gone by.
  [[nodiscard]] Nanoseconds wall(Nanoseconds robot) const {
    return std::chrono::duration_cast<Nanoseconds>(robot / rate_);
  }
  /// What messages say of a time: the same, unless a fault has it otherwise.
  [[nodiscard]] builtin_interfaces::Time stamp(Nanoseconds time) const;

 private:
  bool simulated_;
  double rate_;
  const RobotFaults& faults_;
  std::chrono::steady_clock::time_point begin_;
  mutable std::mutex mutex_;
  mutable std::optional<Nanoseconds> stale_;  ///< the first stamp since stamps stand still
};

}  // namespace canopeer::ros
