#pragma once

#include <vector>

#include "canopeer/robot/blended_path.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

struct PathTimingOptions {
  double max_deviation = 0.05;  ///< how far the path may pass a waypoint, Euclidean, rad (m)
  int line_intervals = 32;      ///< of constant acceleration along the path, per straight piece
  double arc_step_rad = 0.05;   ///< the same on arcs: what the path turns by in one
};

/// The fastest motion along a BlendedPath from standstill to standstill under joint velocity and
/// acceleration limits, up to the grid the path is cut into. Reachability analysis in two passes
/// (Pham & Pham, "A New Approach to Time-Optimal Path Parameterization Based on Reachability
/// Analysis", IEEE T-RO 2018) over intervals of constant acceleration along the path. The limits
/// are imposed on each interval with the ranges that the path's derivatives have in it, not at grid
/// points: they hold at every instant, whatever rate the motion is sampled at. A path that is one
/// straight line takes its closed form (StraightMotion), but for the grid.
class PathMotion {
 public:
  /// At least one waypoint, of the limits' size.
  PathMotion(const std::vector<Configuration>& waypoints, const JointLimits& limits,
             const PathTimingOptions& options = {});

  [[nodiscard]] double duration_s() const { return times_s_.empty() ? 0.0 : times_s_.back(); }
  /// Position, velocity and acceleration at a time, held to [0, duration_s()].
  [[nodiscard]] Configuration at(double t_s) const;
  [[nodiscard]] Configuration velocity_at(double t_s) const;
  [[nodiscard]] Configuration acceleration_at(double t_s) const;
  [[nodiscard]] const BlendedPath& path() const { return path_; }

 private:
  struct Instant {  // place, speed and acceleration along the path
    int piece = 0;
    double s = 0.0;
    double rate = 0.0;
    double acceleration = 0.0;
  };
  [[nodiscard]] Instant instant(double t_s) const;

  BlendedPath path_;
  Configuration end_;
  // Grid points; piece_ and acceleration_ belong to the interval that begins there.
  std::vector<double> s_;
  std::vector<double> rate_;
  std::vector<double> times_s_;
  std::vector<double> acceleration_;
  std::vector<int> piece_;
};

}  // namespace canopeer
