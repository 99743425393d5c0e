#include "canopeer/robot/timing/timing_grid.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/base/hypotenuse.h"

namespace canopeer {
namespace {

constexpr double kBack = 1e-11;     // relative: room for rounding, well below the 1e-9 we promise
constexpr double kShortest = 1e-3;  // rad (m): image motion cuts a path no finer than twice this

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// Range of a sinusoid over a stretch shorter than half a turn, from its values and those of its
/// derivative (up to a positive factor) at the ends.
Range range_of(double at_a, double at_b, double slope_a, double slope_b, double amplitude) {
  Range range{std::min(at_a, at_b), std::max(at_a, at_b)};
  if (slope_a > 0.0 && slope_b < 0.0) range.high = amplitude;
  if (slope_a < 0.0 && slope_b > 0.0) range.low = -amplitude;
  return range;
}

}  // namespace

TimingGrid::TimingGrid(const BlendedPath& path, const JointLimits& limits, const ImageMotion* image,
                       const Fineness& fineness) {
  CANOPEER_CHECK(fineness.arc_step_rad > 0.0, "arcs are cut into steps");
  CANOPEER_CHECK(fineness.image_step > 0.0, "image motion is cut into steps");
  for (std::size_t i = 0; i < path.pieces().size(); ++i) {
    const BlendedPath::Piece& piece = path.pieces()[i];
    const int count = piece.radius > 0.0
                          ? std::max(2, static_cast<int>(std::ceil(piece.length / piece.radius /
                                                                   fineness.arc_step_rad)))
                          : 1;
    const double length = piece.length / count;
    Limited part{piece, static_cast<int>(i), limits, image, fineness.image_step};
    double along = 0.0;
    if (image != nullptr) {
      part.bend = image->bend(piece);
      along = part.along(0.0);
    }
    for (int k = 0; k < count; ++k) {
      const double next = image != nullptr ? part.along((k + 1) * length) : 0.0;
      cut(part, k * length, length, along, next);
      along = next;
    }
    intervals_.back().stops = piece.stops;
  }
}

double TimingGrid::Limited::along(double from_begin) const {
  const double s = piece.begin + from_begin;
  return image->along(BlendedPath::point(piece, s), BlendedPath::tangent(piece, s));
}

TimingInterval TimingGrid::by_joints(const Limited& part, double from, double length) {
  TimingInterval interval;
  interval.length = length;
  interval.piece = part.index;
  interval.line = part.piece.radius == 0.0;
  interval.first_plane = static_cast<int>(planes_.size());
  interval.line ? limit_on_line(part, interval) : limit_on_arc(part, from, interval);
  interval.last_plane = static_cast<int>(planes_.size());
  return interval;
}

/// One interval, or where image motion is what limits it and changes in it, two halves cut again.
void TimingGrid::cut(const Limited& part, double from, double length, double along_begin,
                     double along_end) {
  TimingInterval interval = by_joints(part, from, length);
  if (part.image != nullptr) {
    const double most = std::max(along_begin, along_end) + part.bend * length * length / 8.0;
    const double rate = part.image->limit_px_s() / most;
    const double x = rate * rate * (1.0 - kBack);
    if (x < interval.max_x) {
      const double mean = 0.5 * (along_begin + along_end);
      if (most > mean * (1.0 + part.image_step) && length > 2.0 * kShortest) {
        planes_.resize(static_cast<std::size_t>(interval.first_plane));
        const double half = 0.5 * length;
        const double middle = part.along(from + half);
        cut(part, from, half, along_begin, middle);
        cut(part, from + half, half, middle, along_end);
        return;
      }
      interval.max_x = x;
    }
  }
  intervals_.push_back(interval);
}

TimingGrid::Span TimingGrid::span(const TimingInterval& interval, double x, double next_x) const {
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

// The span's width is concave and piecewise linear in x, so Newton's method from the right ends at
// its root after finitely many steps.
double TimingGrid::controllable(const TimingInterval& interval, double next_x) const {
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

void TimingGrid::tighten(Span& span, const HalfPlane& plane, double x) {
  if (plane.limit == TimingInterval::kNone) return;
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

void TimingGrid::limit_on_line(const Limited& part, TimingInterval& interval) {
  for (int i = 0; i < part.piece.x.size(); ++i) {
    const double slope = std::abs(part.piece.x[i]);
    if (slope == 0.0) continue;
    const double rate = part.limits.velocity[i] / slope;
    interval.max_x = std::min(interval.max_x, rate * rate * (1.0 - kBack));
    interval.max_u = std::min(interval.max_u, part.limits.acceleration[i] / slope * (1.0 - kBack));
  }
}

/// |q' u + q'' X| ≤ a for all q', q'' in their ranges and all X = ṡ² between the interval's ends:
/// linear in each, so the corners are enough.
void TimingGrid::limit_on_arc(const Limited& part, double from, TimingInterval& interval) {
  const BlendedPath::Piece& piece = part.piece;
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
        part.limits.velocity[i] / std::max(std::abs(tangent.low), std::abs(tangent.high));
    const double a = part.limits.acceleration[i] * (1.0 - kBack);
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

}  // namespace canopeer
