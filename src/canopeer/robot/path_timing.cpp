#include "canopeer/robot/path_timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBack = 1e-11;  // relative: room for rounding, well below the 1e-9 we promise

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// slope_u · u + slope_x · x ≤ limit, with x = ṡ² at the interval's start and u = s̈ in it.
struct HalfPlane {
  double slope_u = 0.0;
  double slope_x = 0.0;
  double limit = 0.0;
};

/// What limits one interval of the path.
struct Interval {
  double length = 0.0;
  int piece = 0;
  bool stops = false;       // at its end
  double max_x = kInfinity;  // by the velocity limits
  double max_u = kInfinity;  // by the acceleration limits, on a line
  int first_plane = 0;      // on an arc; in the list of all
  int last_plane = 0;
};

/// Range of a sinusoid over a stretch shorter than half a turn, from its values and those of its
/// derivative (up to a positive factor) at the ends.
Range range_of(double at_a, double at_b, double slope_a, double slope_b, double amplitude) {
  Range range{std::min(at_a, at_b), std::max(at_a, at_b)};
  if (slope_a > 0.0 && slope_b < 0.0) range.high = amplitude;
  if (slope_a < 0.0 && slope_b > 0.0) range.low = -amplitude;
  return range;
}

class Grid {
 public:
  Grid(const BlendedPath& path, const JointLimits& limits, const PathTimingOptions& options) {
    for (std::size_t i = 0; i < path.pieces().size(); ++i) {
      const BlendedPath::Piece& piece = path.pieces()[i];
      const bool arc = piece.radius > 0.0;
      const int count =
          arc ? std::max(2, static_cast<int>(
                                std::ceil(piece.length / piece.radius / options.arc_step_rad)))
              : std::max(2, options.line_intervals);
      for (int k = 0; k < count; ++k) {
        Interval interval;
        interval.length = piece.length / count;
        interval.piece = static_cast<int>(i);
        interval.stops = piece.stops && k + 1 == count;
        interval.first_plane = static_cast<int>(planes_.size());
        arc ? limit_on_arc(piece, k * interval.length, limits, interval)
            : limit_on_line(piece, limits, interval);
        interval.last_plane = static_cast<int>(planes_.size());
        intervals_.push_back(interval);
      }
    }
  }

  [[nodiscard]] const std::vector<Interval>& intervals() const { return intervals_; }

  /// The accelerations allowed from ṡ² = x when the interval must end with ṡ² in [0, next_x].
  struct Span {
    double low = -kInfinity;
    double high = kInfinity;
    double low_slope = 0.0;  // how the bounds change with x
    double high_slope = 0.0;
  };
  [[nodiscard]] Span span(const Interval& interval, double x, double next_x) const {
    Span span;
    const double twice = 2.0 * interval.length;
    tighten(span, {twice, 1.0, next_x}, x);
    tighten(span, {-twice, -1.0, 0.0}, x);
    tighten(span, {1.0, 0.0, interval.max_u}, x);
    tighten(span, {-1.0, 0.0, interval.max_u}, x);
    for (int i = interval.first_plane; i < interval.last_plane; ++i)
      tighten(span, planes_[static_cast<std::size_t>(i)], x);
    return span;
  }

  /// The largest ṡ² at the interval's start from which it can end at next_x or below. The span's
  /// width is concave and piecewise linear in x, so Newton's method from the right ends at its
  /// root after finitely many steps.
  [[nodiscard]] double controllable(const Interval& interval, double next_x) const {
    double x = interval.max_x;
    for (int step = 0; step < 60 && x > 0.0; ++step) {
      const Span here = span(interval, x, next_x);
      const double width = here.high - here.low;
      if (width >= -1e-12 * (1.0 + std::abs(here.high))) break;
      const double slope = here.high_slope - here.low_slope;
      if (!(slope < 0.0)) return 0.0;
      x = std::max(0.0, x - width / slope);
    }
    return std::max(0.0, x * (1.0 - kBack));
  }

 private:
  static void tighten(Span& span, const HalfPlane& plane, double x) {
    if (plane.slope_u == 0.0 || plane.limit == kInfinity) return;
    const double bound = (plane.limit - plane.slope_x * x) / plane.slope_u;
    if (plane.slope_u > 0.0 && bound < span.high) {
      span.high = bound;
      span.high_slope = -plane.slope_x / plane.slope_u;
    }
    if (plane.slope_u < 0.0 && bound > span.low) {
      span.low = bound;
      span.low_slope = -plane.slope_x / plane.slope_u;
    }
  }

  void limit_on_line(const BlendedPath::Piece& piece, const JointLimits& limits,
                     Interval& interval) {
    for (int i = 0; i < piece.x.size(); ++i) {
      const double slope = std::abs(piece.x[i]);
      if (slope == 0.0) continue;
      const double rate = limits.velocity[i] / slope;
      interval.max_x = std::min(interval.max_x, rate * rate * (1.0 - kBack));
      interval.max_u = std::min(interval.max_u, limits.acceleration[i] / slope * (1.0 - kBack));
    }
  }

  /// |q' u + q'' X| ≤ a for all q', q'' in their ranges and all X = ṡ² between the interval's ends:
  /// linear in each, so the corners are enough.
  void limit_on_arc(const BlendedPath::Piece& piece, double from, const JointLimits& limits,
                    Interval& interval) {
    const double r = piece.radius;
    const double ca = std::cos(from / r);
    const double sa = std::sin(from / r);
    const double cb = std::cos((from + interval.length) / r);
    const double sb = std::sin((from + interval.length) / r);
    const double twice = 2.0 * interval.length;
    for (int i = 0; i < piece.x.size(); ++i) {
      const double x = piece.x[i];
      const double y = piece.y[i];
      const double amplitude = std::hypot(x, y);
      if (amplitude < 1e-15) continue;
      const double tangent_a = ca * y - sa * x;
      const double tangent_b = cb * y - sb * x;
      const double bend_a = -(ca * x + sa * y);  // curvature times r: the tangent's slope
      const double bend_b = -(cb * x + sb * y);
      const Range tangent = range_of(tangent_a, tangent_b, bend_a, bend_b, amplitude);
      const Range bend = range_of(bend_a, bend_b, -tangent_a, -tangent_b, amplitude);
      const double rate =
          limits.velocity[i] / std::max(std::abs(tangent.low), std::abs(tangent.high));
      const double a = limits.acceleration[i] * (1.0 - kBack);
      interval.max_x = std::min(interval.max_x, rate * rate * (1.0 - kBack));
      for (const double p : {tangent.low, tangent.high}) {
        for (const double k : {bend.low / r, bend.high / r}) {
          for (const double sign : {1.0, -1.0}) {
            planes_.push_back({sign * p, sign * k, a});                    // X at the start
            planes_.push_back({sign * (p + twice * k), sign * k, a});      // X at the end
          }
        }
      }
    }
  }

  std::vector<Interval> intervals_;
  std::vector<HalfPlane> planes_;
};

}  // namespace

PathMotion::PathMotion(const std::vector<Configuration>& waypoints, const JointLimits& limits,
                       const PathTimingOptions& options)
    : path_(waypoints, options.max_deviation), end_(waypoints.back()) {
  CANOPEER_CHECK(options.line_intervals > 0 && options.arc_step_rad > 0.0, "a grid is needed");
  const Grid grid(path_, limits, options);
  const std::vector<Interval>& intervals = grid.intervals();
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
  double x = 0.0;
  double s = 0.0;
  double t = 0.0;
  for (std::size_t k = 0; k <= count; ++k) {
    s_.push_back(s);
    rate_.push_back(std::sqrt(x));
    times_s_.push_back(t);
    if (k == count) break;
    const Interval& interval = intervals[k];
    const double u = grid.span(interval, x, most[k + 1]).high;
    const double next = std::clamp(x + 2.0 * interval.length * u, 0.0, most[k + 1]);
    acceleration_.push_back((next - x) / (2.0 * interval.length));
    piece_.push_back(interval.piece);
    t += 2.0 * interval.length / (std::sqrt(x) + std::sqrt(next));
    s += interval.length;
    x = next;
  }
}

PathMotion::Instant PathMotion::instant(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s());
  const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), t);
  const auto k = std::min(acceleration_.size() - 1,
                          static_cast<std::size_t>(std::max<std::ptrdiff_t>(
                              0, after - times_s_.begin() - 1)));
  const double passed = t - times_s_[k];
  Instant now;
  now.piece = piece_[k];
  now.acceleration = acceleration_[k];
  now.rate = std::max(0.0, rate_[k] + now.acceleration * passed);
  // Rounding must not lead beyond the interval, into another piece's limits.
  now.rate = std::min(now.rate, std::max(rate_[k], rate_[k + 1]));
  now.s = std::clamp(s_[k] + passed * (rate_[k] + 0.5 * now.acceleration * passed), s_[k], s_[k + 1]);
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
  return now.rate * BlendedPath::tangent(path_.pieces()[static_cast<std::size_t>(now.piece)], now.s);
}

Configuration PathMotion::acceleration_at(double t_s) const {
  if (times_s_.empty()) return Configuration::Zero(end_.size());
  const Instant now = instant(t_s);
  const BlendedPath::Piece& piece = path_.pieces()[static_cast<std::size_t>(now.piece)];
  return now.acceleration * BlendedPath::tangent(piece, now.s) +
         now.rate * now.rate * BlendedPath::curvature(piece, now.s);
}

}  // namespace canopeer
