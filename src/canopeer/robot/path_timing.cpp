#include "canopeer/robot/path_timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canopeer/base/check.h"
#include "canopeer/base/hypotenuse.h"

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
  bool stops = false;        // at its end
  bool line = false;         // a whole straight piece
  double max_x = kInfinity;  // by the velocity limits
  double max_u = kInfinity;  // by the acceleration limits, on a line
  int first_plane = 0;       // on an arc; in the list of all
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
  Grid(const BlendedPath& path, const JointLimits& limits, double arc_step_rad) {
    for (std::size_t i = 0; i < path.pieces().size(); ++i) {
      const BlendedPath::Piece& piece = path.pieces()[i];
      const bool arc = piece.radius > 0.0;
      const int count =
          arc ? std::max(2, static_cast<int>(std::ceil(piece.length / piece.radius / arc_step_rad)))
              : 1;
      for (int k = 0; k < count; ++k) {
        Interval interval;
        interval.length = piece.length / count;
        interval.piece = static_cast<int>(i);
        interval.line = !arc;
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
    if (interval.line)
      return std::min(interval.max_x, next_x + 2.0 * interval.length * interval.max_u);
    double x = interval.max_x;
    for (int step = 0; step < 100; ++step) {
      const Span here = span(interval, x, next_x);
      const double width = here.high - here.low;
      if (width >= 0.0) break;
      const double slope = here.high_slope - here.low_slope;
      const double closer = slope < 0.0 ? std::max(0.0, x - width / slope) : 0.0;
      x = std::min(closer, x * (1.0 - 1e-13));  // never stuck at a bound that is all but vertical
    }
    return std::max(0.0, x * (1.0 - kBack));
  }

 private:
  static void tighten(Span& span, const HalfPlane& plane, double x) {
    if (plane.limit == kInfinity) return;
    // A slope of nothing limits x alone; a tiny one does the same here.
    const double slope_u = std::abs(plane.slope_u) > 1e-14 ? plane.slope_u : 1e-14;
    const double bound = (plane.limit - plane.slope_x * x) / slope_u;
    if (slope_u > 0.0 && bound < span.high) {
      span.high = bound;
      span.high_slope = -plane.slope_x / slope_u;
    }
    if (slope_u < 0.0 && bound > span.low) {
      span.low = bound;
      span.low_slope = -plane.slope_x / slope_u;
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
      const double amplitude = hypotenuse(x, y);
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
            planes_.push_back({sign * p, sign * k, a});                // X at the start
            planes_.push_back({sign * (p + twice * k), sign * k, a});  // X at the end
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
    : PathMotion(JointPath{waypoints, std::vector<double>(waypoints.size(), options.max_deviation)},
                 limits, options.arc_step_rad) {}

PathMotion::PathMotion(const JointPath& path, const JointLimits& limits, double arc_step_rad)
    : path_(path), end_(path.waypoints.back()) {
  time_path(limits, arc_step_rad);
  const bool rounded = std::any_of(path_.pieces().begin(), path_.pieces().end(),
                                   [](const auto& piece) { return piece.radius > 0.0; });
  if (!rounded) return;
  // A tight arc is passed slowly by a joint of little acceleration: stopping may be faster.
  PathMotion other(JointPath{path.waypoints}, limits, arc_step_rad);
  if (other.duration_s() < duration_s()) *this = std::move(other);
}

void PathMotion::time_path(const JointLimits& limits, double arc_step_rad) {
  CANOPEER_CHECK(arc_step_rad > 0.0, "arcs are cut into steps");
  const Grid grid(path_, limits, arc_step_rad);
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
  s_ = {0.0};
  rate_ = {0.0};
  times_s_ = {0.0};
  double x = 0.0;
  const auto advance = [&](const Interval& interval, double length, double next) {
    if (length <= 0.0) return;
    acceleration_.push_back((next - x) / (2.0 * length));
    piece_.push_back(interval.piece);
    times_s_.push_back(times_s_.back() + 2.0 * length / (std::sqrt(x) + std::sqrt(next)));
    s_.push_back(s_.back() + length);
    rate_.push_back(std::sqrt(next));
    x = next;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Interval& interval = intervals[k];
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
