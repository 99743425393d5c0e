#include "canopeer/robot/corner_rounding.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

double widest_free_arc(const Configuration& before, const Configuration& corner,
                       const Configuration& after, const CollisionChecker& checker,
                       int& states_checked, const CornerRoundingOptions& options) {
  for (double deviation = options.max_deviation_rad; deviation >= options.min_deviation_rad;
       deviation /= 2.0) {
    const BlendedPath path({before, corner, after}, deviation);
    const auto arc = std::find_if(path.pieces().begin(), path.pieces().end(),
                                  [](const auto& piece) { return piece.radius > 0.0; });
    if (arc == path.pieces().end()) return 0.0;  // no corner, or one that turns back
    if (checker.arc_free(*arc, &states_checked)) return deviation;
  }
  return 0.0;
}

template <typename Time>
JointPath faster_rounded(const JointPath& stopping, const Time& time,
                         const CollisionChecker& checker, int& states_checked,
                         const CornerRoundingOptions& options) {
  const std::vector<Configuration>& waypoints = stopping.waypoints;
  if (waypoints.size() < 3) return stopping;
  JointPath rounded = stopping;
  rounded.deviations.assign(waypoints.size(), 0.0);
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    rounded.deviations[i] = widest_free_arc(waypoints[i - 1], waypoints[i], waypoints[i + 1],
                                            checker, states_checked, options);
  }
  constexpr double kWorthIt = 1.0 - 1e-6;
  return time(rounded) < kWorthIt * time(stopping) ? rounded : stopping;
}

}  // namespace

JointPath round_corners(const std::vector<Configuration>& waypoints, const JointLimits& limits,
                        const CollisionChecker& checker, int& states_checked,
                        const CornerRoundingOptions& options) {
  const auto time = [&](const JointPath& path) { return motion_time(path, limits); };
  return faster_rounded(JointPath{waypoints}, time, checker, states_checked, options);
}

JointPath round_corners(const JointPath& path, const RobotModel& robot,
                        const CollisionChecker& checker, int& states_checked,
                        const CornerRoundingOptions& options) {
  const JointPath stopping{path.waypoints, {}, path.sharp};
  const auto time = [&](const JointPath& way) { return motion_time(way, robot); };
  return faster_rounded(stopping, time, checker, states_checked, options);
}

std::vector<Configuration> points_along(const JointPath& path, double arc_step) {
  CANOPEER_CHECK(arc_step > 0.0, "arcs are cut into steps");
  if (path.deviations.empty()) return path.waypoints;
  const BlendedPath blended(path);
  std::vector<Configuration> points = {blended.start()};
  for (const BlendedPath::Piece& piece : blended.pieces()) {
    const int steps =
        piece.radius > 0.0 ? std::max(1, static_cast<int>(std::ceil(piece.length / arc_step))) : 1;
    for (int k = 1; k <= steps; ++k)
      points.push_back(BlendedPath::point(piece, piece.begin + piece.length * k / steps));
  }
  points.back() = path.waypoints.back();
  return points;
}

double motion_time(const JointPath& path, const JointLimits& limits) {
  if (!path.deviations.empty()) return PathMotion(path, limits).duration_s();
  double time_s = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i)
    time_s += motion_time(path.waypoints[i - 1], path.waypoints[i], limits);
  return time_s;
}

double motion_time(const JointPath& path, const RobotModel& robot) {
  if (!path.sharp) return motion_time(path, robot.limits());
  return PathMotion(path, robot).duration_s();
}

}  // namespace canopeer
