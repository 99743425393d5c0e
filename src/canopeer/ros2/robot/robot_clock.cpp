#include "canopeer/ros2/robot/robot_clock.h"

namespace canopeer::ros {

RobotClock::RobotClock(bool simulated, double rate, const RobotFaults& faults)
    : simulated_(simulated),
      rate_(simulated ? rate : 1.0),
      faults_(faults),
      begin_(std::chrono::steady_clock::now()) {}

Stamp RobotClock::now() const {
  if (!simulated_) {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::nanoseconds(since_1970).count();
  }
  const std::chrono::duration<double> ran = std::chrono::steady_clock::now() - begin_;
  return nanoseconds(ran.count() * rate_);
}

std::chrono::nanoseconds RobotClock::wall(Stamp time) const {
  return std::chrono::nanoseconds(nanoseconds(seconds(time) / rate_));
}

builtin_interfaces::Time RobotClock::said(Stamp time) const {
  if (const auto offset = faults_.values(RobotFault::clock_offset)) {
    time += nanoseconds((*offset)[0]);
  }
  const std::scoped_lock lock(mutex_);
  if (!faults_.on(RobotFault::stale_stamps)) {
    stale_.reset();
  } else {
    if (!stale_) stale_ = time;
    time = *stale_;
  }
  return ros_time(time);
}

}  // namespace canopeer::ros
