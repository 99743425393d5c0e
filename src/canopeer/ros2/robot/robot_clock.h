#pragma once

#include <chrono>

#include "canopeer/ros2/robot/robot_faults.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// The robot's time: the wall's since 1970, or one of its own that began when it was made. Safe to
/// use from several threads.
class RobotClock {
 public:
  /// `rate`: how fast a simulated clock runs, against the wall's. `faults` outlive the clock.
  RobotClock(bool simulated, double rate, const RobotFaults& faults);

  /// The time by which things happen.
  [[nodiscard]] Stamp now() const;
  [[nodiscard]] bool simulated() const { return simulated_; }
  /// How long that much time is on the wall's clock.
  [[nodiscard]] std::chrono::nanoseconds wall(Stamp time) const;
  /// What messages say of a time: the same, unless a fault has it otherwise.
  [[nodiscard]] builtin_interfaces::Time said(Stamp time) const;

 private:
  bool simulated_;
  double rate_;
  const RobotFaults& faults_;
  std::chrono::steady_clock::time_point begin_;
  mutable std::mutex mutex_;
  mutable std::optional<Stamp> stale_;  ///< the first stamp since stamps stand still
};

}  // namespace canopeer::ros
