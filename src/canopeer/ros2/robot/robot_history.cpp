#include "canopeer/ros2/robot/robot_history.h"

#include <algorithm>

namespace canopeer::ros {

namespace {
constexpr Stamp kRemembered = 5 * kNanosecondsPerSecond;
}

void RobotHistory::add(Stamp time, const SimulatedPlace& place) {
  const std::scoped_lock lock(mutex_);
  entries_.push_back({time, place});
  while (entries_.front().time < time - kRemembered) entries_.pop_front();
}

std::optional<SimulatedPlace> RobotHistory::at(Stamp time) const {
  const std::scoped_lock lock(mutex_);
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), time,
                                      [](const Entry& e, Stamp t) { return e.time < t; });
  if (after == entries_.end() || after == entries_.begin()) return {};
  const Entry& a = *(after - 1);
  const Entry& b = *after;
  const double s = static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
  const auto between = [s](double x, double y) { return x + s * (y - x); };
  return SimulatedPlace{a.place.q + s * (b.place.q - a.place.q),
                        {between(a.place.trolley.travel_m, b.place.trolley.travel_m),
                         between(a.place.trolley.lift_m, b.place.trolley.lift_m)}};
}

}  // namespace canopeer::ros
