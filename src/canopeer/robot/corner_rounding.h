#pragma once

#include <vector>

#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/joint_path.h"

namespace canopeer {

/// How far a rounded corner may leave the planned path.
struct CornerRoundingOptions {
  double max_deviation_rad = 0.4;   ///< tried first at each corner, then halved
  double min_deviation_rad = 0.01;  ///< corners with no free arc down to this are stopped at
};

/// A path that follows `waypoints` without stopping where it need not. Each corner gets the widest
/// arc that `checker` calls free throughout (CollisionChecker::arc_free), independent of the
/// others. The lines in between are not checked: they are parts of the given ones. Where stopping
/// at all corners is no slower, all are kept. Each state looked at is added to `states_checked`.
[[nodiscard]] JointPath round_corners(const std::vector<Configuration>& waypoints,
                                      const JointLimits& limits, const CollisionChecker& checker,
                                      int& states_checked,
                                      const CornerRoundingOptions& options = {});
/// The same for the waypoints of `path`, under its limit on image motion, which the answer keeps.
[[nodiscard]] JointPath round_corners(const JointPath& path, const RobotModel& robot,
                                      const CollisionChecker& checker, int& states_checked,
                                      const CornerRoundingOptions& options = {});

/// Points along a path: waypoints it stops at, ends of its lines, and on its arcs points no more
/// than `arc_step` of path length apart.
[[nodiscard]] std::vector<Configuration> points_along(const JointPath& path,
                                                      double arc_step = 0.02);

/// How long the fastest motion along a path takes under the limits, s: stopping where the path
/// says so.
[[nodiscard]] double motion_time(const JointPath& path, const JointLimits& limits);
/// The same under the robot's limits and `path.sharp`: the time of PathMotion(path, robot).
[[nodiscard]] double motion_time(const JointPath& path, const RobotModel& robot);

}  // namespace canopeer
