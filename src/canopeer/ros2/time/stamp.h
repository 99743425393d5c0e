#pragma once

#include <cmath>
#include <cstdint>

#include "canopeer/cdr/messages/builtin_interfaces.h"

namespace canopeer::ros {

/// ROS time in nanoseconds: since 1970, or since a simulation began (`use_sim_time`).
using Stamp = std::int64_t;

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

[[nodiscard]] inline Stamp stamp_of(const builtin_interfaces::Time& time) {
  return std::int64_t{time.sec} * kNanosecondsPerSecond + std::int64_t{time.nanosec};
}
[[nodiscard]] inline builtin_interfaces::Time ros_time(Stamp stamp) {
  builtin_interfaces::Time time;
  const std::int64_t rest =
      ((stamp % kNanosecondsPerSecond) + kNanosecondsPerSecond) % kNanosecondsPerSecond;
  time.sec = static_cast<std::int32_t>((stamp - rest) / kNanosecondsPerSecond);
  time.nanosec = static_cast<std::uint32_t>(rest);
  return time;
}
/// Seconds to nanoseconds and back.
[[nodiscard]] inline std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}
[[nodiscard]] inline double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace canopeer::ros
