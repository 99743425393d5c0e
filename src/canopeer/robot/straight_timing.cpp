#include "canopeer/robot/straight_timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canopeer/robot/timing/image_motion.h"

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

/// Unit distance in equal parts, each with its largest ṡ² and |s̈| ≤ u, standing at both ends: the
/// two passes of PathMotion.
template <std::size_t n>
double time_in_parts(const std::array<double, n>& most_x, double u) {
  constexpr double kLength = 1.0 / n;
  std::array<double, n + 1> begin_x{};  // at most, so that all ahead can be kept
  for (std::size_t k = n; k-- > 1;)
    begin_x[k] = std::min({most_x[k - 1], most_x[k], begin_x[k + 1] + 2.0 * kLength * u});
  double time_s = 0.0;
  double x = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double end = std::min(begin_x[k + 1], x + 2.0 * kLength * u);
    const double highest = std::max({x, end, std::min(most_x[k], (x + end) / 2.0 + kLength * u)});
    const double rate = std::sqrt(highest);
    const double cruise = kLength - (2.0 * highest - x - end) / (2.0 * u);
    time_s += (2.0 * rate - std::sqrt(x) - std::sqrt(end)) / u + std::max(0.0, cruise) / rate;
    x = end;
  }
  return time_s;
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

double straight_motion_time(const Configuration& a, const Configuration& b, const RobotModel& robot,
                            const std::optional<ImageMotionLimit>& sharp) {
  const LineLimits line = line_limits(a, b, robot.limits());
  if (!std::isfinite(line.rate)) return 0.0;
  const double by_joints = unit_time(line.rate, line.acceleration);
  if (!sharp) return by_joints;

  constexpr std::size_t kParts = 8;
  const ImageMotion image(robot, *sharp);
  const Configuration delta = b - a;
  const double joints_x = line.rate * line.rate;
  std::array<double, kParts> most_x{};  // ṡ² in each part, by its mean image motion
  bool limited = false;
  double along = image.along(a, delta);
  for (std::size_t k = 0; k < kParts; ++k) {
    const double next = image.along(a + static_cast<double>(k + 1) / kParts * delta, delta);
    const double rate = 2.0 * image.limit_px_s() / (along + next);
    most_x[k] = std::min(joints_x, rate * rate);
    limited = limited || most_x[k] < joints_x;
    along = next;
  }
  return limited ? std::max(by_joints, time_in_parts(most_x, line.acceleration)) : by_joints;
}

double axis_motion_time(double distance, double velocity_limit, double acceleration_limit) {
  const double length = std::abs(distance);
  if (length == 0.0) return 0.0;
  return unit_time(velocity_limit / length, acceleration_limit / length);
}

}  // namespace canopeer
