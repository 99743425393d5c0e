#include "canopeer/robot/path_timing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "canopeer/robot/timing/timing_grid.h"

namespace canopeer {
namespace {

std::optional<ImageMotion> image_limit(const JointPath& path, const RobotModel& robot) {
  if (!path.sharp) return std::nullopt;
  return ImageMotion(robot, *path.sharp);
}

const ImageMotion* pointer_to(const std::optional<ImageMotion>& image) {
  return image ? &*image : nullptr;
}

}  // namespace

PathMotion::PathMotion(const std::vector<Configuration>& waypoints, const JointLimits& limits,
                       const PathTimingOptions& options)
    : PathMotion(JointPath{waypoints, std::vector<double>(waypoints.size(), options.max_deviation)},
                 limits, nullptr, options) {}

PathMotion::PathMotion(const JointPath& path, const JointLimits& limits, double arc_step_rad)
    : PathMotion(path, limits, nullptr, {.arc_step_rad = arc_step_rad}) {}

PathMotion::PathMotion(const JointPath& path, const RobotModel& robot,
                       const PathTimingOptions& options)
    : PathMotion(path, robot, robot.limits(), options) {}

PathMotion::PathMotion(const JointPath& path, const RobotModel& robot, const JointLimits& limits,
                       const PathTimingOptions& options)
    : PathMotion(path, limits, pointer_to(image_limit(path, robot)), options) {}

PathMotion::PathMotion(const JointPath& path, const JointLimits& limits, const ImageMotion* image,
                       const PathTimingOptions& options)
    : path_(path), end_(path.waypoints.back()) {
  time_path(TimingGrid(path_, limits, image, {options.arc_step_rad, options.image_step}));
  const bool rounded = std::any_of(path_.pieces().begin(), path_.pieces().end(),
                                   [](const auto& piece) { return piece.radius > 0.0; });
  if (!rounded) return;
  // A tight arc is passed slowly by a joint of little acceleration: stopping may be faster.
  PathMotion other(JointPath{path.waypoints}, limits, image, options);
  if (other.duration_s() < duration_s()) *this = std::move(other);
}

void PathMotion::time_path(const TimingGrid& grid) {
  const std::vector<TimingInterval>& intervals = grid.intervals();
  if (intervals.empty()) return;
  const std::size_t count = intervals.size();

  // Backwards: how fast may it be at each grid point so that it can still keep all limits ahead?
  std::vector<double> most(count + 1, 0.0);
  for (std::size_t k = count; k-- > 0;) {
    most[k] = grid.controllable(intervals[k], most[k + 1]);
    if (k == 0 || intervals[k - 1].stops) most[k] = 0.0;
    if (k > 0) most[k] = std::min(most[k], intervals[k - 1].max_x);
  }
  // Forwards: as fast as that allows.
  s_ = {0.0};
  rate_ = {0.0};
  times_s_ = {0.0};
  double x = 0.0;
  const auto advance = [&](const TimingInterval& interval, double length, double next) {
    if (length <= 0.0) return;
    acceleration_.push_back((next - x) / (2.0 * length));
    piece_.push_back(interval.piece);
    times_s_.push_back(times_s_.back() + 2.0 * length / (std::sqrt(x) + std::sqrt(next)));
    s_.push_back(s_.back() + length);
    rate_.push_back(std::sqrt(next));
    x = next;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const TimingInterval& interval = intervals[k];
    if (!interval.line) {
      const double u = grid.span(interval, x, most[k + 1]).high;
      advance(interval, interval.length,
              std::clamp(x + 2.0 * interval.length * u, 0.0, most[k + 1]));
      continue;
    }
    // On a line: speed up, cruise unless it is too short, slow down.
    const double u = interval.max_u;
    const double end = std::min(most[k + 1], x + 2.0 * interval.length * u);
    const double peak = std::min(interval.max_x, (x + end) / 2.0 + interval.length * u);
    const double speeding = std::min(interval.length, std::max(0.0, peak - x) / (2.0 * u));
    const double slowing =
        std::min(interval.length - speeding, std::max(0.0, peak - end) / (2.0 * u));
    const double highest = std::max(peak, x);
    advance(interval, speeding, highest);
    advance(interval, interval.length - speeding - slowing, highest);
    advance(interval, slowing, end);
  }
}

PathMotion::Instant PathMotion::instant(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s());
  const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), t);
  const auto k =
      std::min(acceleration_.size() - 1,
               static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - times_s_.begin() - 1)));
  const double passed = t - times_s_[k];
  Instant now;
  now.piece = piece_[k];
  now.acceleration = acceleration_[k];
  now.rate = std::max(0.0, rate_[k] + now.acceleration * passed);
  // Rounding must not lead beyond the interval, into another piece's limits.
  now.rate = std::min(now.rate, std::max(rate_[k], rate_[k + 1]));
  now.s =
      std::clamp(s_[k] + passed * (rate_[k] + 0.5 * now.acceleration * passed), s_[k], s_[k + 1]);
  return now;
}

Configuration PathMotion::at(double t_s) const {
  if (times_s_.empty() || t_s >= duration_s()) return end_;
  const Instant now = instant(t_s);
  return BlendedPath::point(path_.pieces()[static_cast<std::size_t>(now.piece)], now.s);
}

Configuration PathMotion::velocity_at(double t_s) const {
  if (times_s_.empty()) return Configuration::Zero(end_.size());
  const Instant now = instant(t_s);
  return now.rate *
         BlendedPath::tangent(path_.pieces()[static_cast<std::size_t>(now.piece)], now.s);
}

Configuration PathMotion::acceleration_at(double t_s) const {
  if (times_s_.empty()) return Configuration::Zero(end_.size());
  const Instant now = instant(t_s);
  const BlendedPath::Piece& piece = path_.pieces()[static_cast<std::size_t>(now.piece)];
  return now.acceleration * BlendedPath::tangent(piece, now.s) +
         now.rate * now.rate * BlendedPath::curvature(piece, now.s);
}

}  // namespace canopeer
