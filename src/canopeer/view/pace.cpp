#include "canopeer/view/pace.h"

#include <algorithm>
#include <thread>

namespace canopeer {
namespace {

constexpr double kNap = 0.05;  // s, so that a change of pace is felt at once
constexpr double kLate = 1.0;  // s

}  // namespace

void Pace::set(double factor) {
  const std::scoped_lock lock(mutex_);
  factor_ = std::max(0.0, factor);
  fresh_ = true;
}

double Pace::ahead_s(double t_s) {
  const std::scoped_lock lock(mutex_);
  if (factor_ <= 0.0) return 0.0;
  const Time now = std::chrono::steady_clock::now();
  if (fresh_ || t_s < from_s_) {
    fresh_ = false;
    from_s_ = t_s;
    from_ = now;
  }
  const double ahead =
      (t_s - from_s_) / factor_ - std::chrono::duration<double>(now - from_).count();
  if (ahead < -kLate) fresh_ = true;  // nor that of a slow machine
  return ahead;
}

SteeringWord Pace::ask(const SteeringPoint& point) {
  if (point.holding) {
    const std::scoped_lock lock(mutex_);
    fresh_ = true;  // the time of a pause is not made up for
    return {};
  }
  for (double wait_s = ahead_s(point.t_s); wait_s > 0.0 && !give_up_(); wait_s = ahead_s(point.t_s))
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait_s, kNap)));
  return {};
}

}  // namespace canopeer
