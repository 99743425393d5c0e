#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// How hard a MotionPlanner tries.
struct MotionPlannerOptions {
  int max_iterations = 20000;   ///< of RRTConnect; a count, so that a plan is no matter of time
  int shortcut_attempts = 200;  ///< tries to cut a corner of the path found
  double range_rad = 1.0;       ///< longest tree extension, Euclidean joint distance
  int escape_attempts = 300;    ///< nearby states tried when the start itself is not free
  double sampling_margin_rad = 3.14159265358979;  ///< joints are sampled this far beyond start and
                                                  ///< goal, within the limits
};

/// Work done by a plan() call, to charge for.
struct MotionPlanStats {
  int states_checked = 0;
  int iterations = 0;
};

/// Long moves: the straight line when it is free, else RRTConnect (Kuffner & LaValle 2000, OMPL)
/// with shortcuts that save motion time. The same (start, goal, seed, checker) give the same path,
/// whatever ran before and in however many threads. Const, safe to call from several threads.
class MotionPlanner {
 public:
  /// `robot` must outlive the planner.
  explicit MotionPlanner(const RobotModel& robot, const MotionPlannerOptions& options = {});

  /// Waypoints from start to goal, both included, joined by collision-free straight motions. Joints
  /// that turn without end run on from the start's values, the shorter way round where it is free:
  /// the last waypoint may be whole turns from `goal`. Empty when the goal collides or the
  /// iterations did not suffice. A start that collides by now, because the map learnt more, is
  /// first left for a free state nearby (CollisionChecker::escape_free).
  [[nodiscard]] std::optional<std::vector<Configuration>> plan(
      const Configuration& start, const Configuration& goal, const CollisionChecker& checker,
      std::uint64_t seed, MotionPlanStats* stats = nullptr) const;

 private:
  const RobotModel* robot_;
  MotionPlannerOptions options_;
};

}  // namespace canopeer
