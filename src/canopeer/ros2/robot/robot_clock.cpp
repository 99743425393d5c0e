#include "canopeer/ros2/robot/robot_clock.h"

namespace canopeer::ros {

RobotClock::RobotClock(bool simulated, double rate, const RobotFaults& faults)
    : simulated_(simulated),
      rate_(simulated ? rate : 1.0),
      faults_(faults),
      begin_(std::chrono::steady_clock::now()) {}

Nanoseconds RobotClock::now() const {
  if (!simulated_) return std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<Nanoseconds>((std::chrono::steady_clock::now() - begin_) *
                                                 rate_);
}

builtin_interfaces::Time RobotClock::stamp(Nanoseconds time) const {
  if (const auto offset = faults_.values(RobotFault::clock_offset)) {
    time += std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>((*offset)[0]));
  }
  {
    const std::scoped_lock lock(mutex_);
    if (!faults_.on(RobotFault::stale_stamps)) {
      stale_.reset();
    } else {
      if (!stale_) stale_ = time;
      time = *stale_;
    }
  }
  const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
  return {static_cast<std::int32_t>(seconds.count()),
          static_cast<std::uint32_t>((time - seconds).count())};
}

}  // namespace canopeer::ros
