#include "canopeer/robot/straight_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace canopeer {
namespace {

/// Highest ṡ and s̈ of the whole line: each joint allows its limit over |Δ_i|, the slowest rules.
/// Infinite when nothing moves.
struct LineLimits {
  double rate = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();
};

LineLimits line_limits(const Configuration& a, const Configuration& b, const JointLimits& limits) {
  LineLimits line;
  for (int i = 0; i < a.size(); ++i) {
    const double delta = std::abs(b[i] - a[i]);
    if (delta == 0.0) continue;
    line.rate = std::min(line.rate, limits.velocity[i] / delta);
    line.acceleration = std::min(line.acceleration, limits.acceleration[i] / delta);
  }
  return line;
}

/// Unit distance from standstill to standstill: speed up, cruise unless too short, slow down.
double unit_time(double rate, double acceleration) {
  if (rate * rate >= acceleration) return 2.0 / std::sqrt(acceleration);  // cruise is not reached
  return 1.0 / rate + rate / acceleration;
}

}  // namespace

StraightMotion::StraightMotion(const Configuration& from, const Configuration& to,
                               const JointLimits& limits)
    : from_(from), to_(to) {
  const LineLimits line = line_limits(from, to, limits);
  if (!std::isfinite(line.rate)) return;
  acceleration_ = line.acceleration;
  rate_ = std::min(line.rate, std::sqrt(line.acceleration));
  duration_s_ = unit_time(line.rate, line.acceleration);
}

double StraightMotion::fraction_at(double t_s) const {
  if (t_s <= 0.0) return duration_s_ > 0.0 ? 0.0 : 1.0;
  if (t_s >= duration_s_) return 1.0;
  const double ramp_s = rate_ / acceleration_;
  if (t_s < ramp_s) return 0.5 * acceleration_ * t_s * t_s;
  const double left_s = duration_s_ - t_s;
  if (left_s < ramp_s) return 1.0 - 0.5 * acceleration_ * left_s * left_s;
  return rate_ * (t_s - 0.5 * ramp_s);
}

Configuration StraightMotion::at(double t_s) const {
  const double s = fraction_at(t_s);
  if (s >= 1.0) return to_;
  return from_ + s * (to_ - from_);
}

double motion_time(const Configuration& a, const Configuration& b, const JointLimits& limits) {
  const LineLimits line = line_limits(a, b, limits);
  return std::isfinite(line.rate) ? unit_time(line.rate, line.acceleration) : 0.0;
}

double axis_motion_time(double distance, double velocity_limit, double acceleration_limit) {
  const double length = std::abs(distance);
  if (length == 0.0) return 0.0;
  return unit_time(velocity_limit / length, acceleration_limit / length);
}

}  // namespace canopeer
