#include "canopeer/robot/timing/blended_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr double kSamePoint = 1e-9;       // waypoints nearer to each other than this are one
constexpr double kSmallestRadius = 1e-5;  // sharper corners are stopped at
constexpr double kStraight = 1e-9;        // rad: no corner at all

}  // namespace

BlendedPath::BlendedPath(const std::vector<Configuration>& waypoints, double max_deviation)
    : BlendedPath(JointPath{waypoints, std::vector<double>(waypoints.size(), max_deviation)}) {}

BlendedPath::BlendedPath(const JointPath& path) {
  CANOPEER_CHECK(!path.waypoints.empty(), "a path needs a waypoint");
  CANOPEER_CHECK(path.deviations.empty() || path.deviations.size() == path.waypoints.size(),
                 "a deviation for each waypoint");
  std::vector<Configuration> corners;
  std::vector<double> deviations;
  for (std::size_t i = 0; i < path.waypoints.size(); ++i) {
    const double deviation = path.deviations.empty() ? 0.0 : path.deviations[i];
    CANOPEER_CHECK(deviation >= 0.0, "a path deviates by no less than nothing");
    if (!corners.empty() && (path.waypoints[i] - corners.back()).norm() <= kSamePoint) continue;
    corners.push_back(path.waypoints[i]);
    deviations.push_back(deviation);
  }
  start_ = corners.front();
  Configuration from = start_;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Configuration before = corners[i] - corners[i - 1];
    const Configuration after = corners[i + 1] - corners[i];
    const Configuration y1 = before.normalized();
    const Configuration y2 = after.normalized();
    // Half the angle the path turns by; exact for small angles too.
    const double half = std::atan2((y2 - y1).norm(), (y1 + y2).norm());
    if (2.0 * half < kStraight) continue;  // the next line goes on where this one does
    double cut = std::min(before.norm(), after.norm()) / 2.0;
    const double sagitta = 1.0 - std::cos(half);  // per unit of cut, times sin(half)
    if (cut * sagitta > deviations[i] * std::sin(half))
      cut = deviations[i] * std::sin(half) / sagitta;
    const double radius = cut / std::tan(half);
    if (!(radius > kSmallestRadius)) {
      add_line(from, corners[i], true);
      from = corners[i];
      continue;
    }
    Piece arc;
    add_line(from, corners[i] - cut * y1, false);
    arc.begin = length_;
    arc.length = 2.0 * half * radius;
    arc.radius = radius;
    arc.origin = corners[i] + (y2 - y1).normalized() * (radius / std::cos(half));
    arc.x = (corners[i] - cut * y1 - arc.origin).normalized();
    arc.y = y1;
    length_ += arc.length;
    from = corners[i] + cut * y2;
    pieces_.push_back(std::move(arc));
  }
  if (corners.size() > 1) add_line(from, corners.back(), true);
  if (!pieces_.empty()) pieces_.back().stops = true;
}

void BlendedPath::add_line(const Configuration& from, const Configuration& to, bool stops) {
  const double length = (to - from).norm();
  if (length < kSamePoint) {
    if (stops && !pieces_.empty()) pieces_.back().stops = true;
    return;
  }
  Piece line;
  line.begin = length_;
  line.length = length;
  line.origin = from;
  line.x = (to - from) / length;
  line.y = Configuration::Zero(from.size());
  line.stops = stops;
  length_ += length;
  pieces_.push_back(std::move(line));
}

int BlendedPath::piece_at(double s) const {
  CANOPEER_CHECK(!pieces_.empty(), "a path of no length has no pieces");
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                      [](double at, const Piece& p) { return at < p.begin; });
  return std::max(0, static_cast<int>(after - pieces_.begin()) - 1);
}

Configuration BlendedPath::point(const Piece& piece, double s) {
  const double along = s - piece.begin;
  if (piece.radius == 0.0) return piece.origin + along * piece.x;
  const double angle = along / piece.radius;
  return piece.origin + piece.radius * (std::cos(angle) * piece.x + std::sin(angle) * piece.y);
}

Configuration BlendedPath::tangent(const Piece& piece, double s) {
  if (piece.radius == 0.0) return piece.x;
  const double angle = (s - piece.begin) / piece.radius;
  return std::cos(angle) * piece.y - std::sin(angle) * piece.x;
}

Configuration BlendedPath::curvature(const Piece& piece, double s) {
  if (piece.radius == 0.0) return Configuration::Zero(piece.x.size());
  const double angle = (s - piece.begin) / piece.radius;
  return (std::cos(angle) * piece.x + std::sin(angle) * piece.y) / -piece.radius;
}

}  // namespace canopeer
