#pragma once

#include <vector>

#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/timing/blended_path.h"

namespace canopeer {

class ImageMotion;
class TimingGrid;

/// How far a timed path may pass its corners, and how finely arcs are cut.
struct PathTimingOptions {
  double max_deviation = 0.05;  ///< how far the path may pass a waypoint, Euclidean, rad (m); for
                                ///< paths that say it themselves it has no meaning
  double arc_step_rad = 0.05;   ///< what the path turns by in one interval of constant
                                ///< acceleration along an arc; lines need no grid
  /// Where image motion is limited: the share of its speed that one interval may give away because
  /// its fastest place rules all of it.
  double image_step = 0.03;
};

/// The fastest motion along a BlendedPath from standstill to standstill under joint velocity and
/// acceleration limits, up to the grid that arcs are cut into. Reachability analysis in two passes
/// (Pham & Pham, "A New Approach to Time-Optimal Path Parameterization Based on Reachability
/// Analysis", IEEE T-RO 2018) over intervals of constant acceleration along the path.
///
/// A departure: the limits are imposed on each interval, with the ranges that the path's
/// derivatives have in it, not at grid points. So they hold at every instant, whatever rate the
/// motion is sampled at. Straight pieces are timed in closed form, so a path that is one straight
/// line takes the time of StraightMotion.
///
/// A limit on image motion (JointPath::sharp) is one more bound on the rate, place by place. It
/// cuts lines into intervals too, but only where it is what limits them (decision 105).
class PathMotion {
 public:
  /// At least one waypoint, of the limits' size. Never slower than stopping at every waypoint: the
  /// path keeps its corners where that is faster on the whole.
  PathMotion(const std::vector<Configuration>& waypoints, const JointLimits& limits,
             const PathTimingOptions& options = {});
  /// The same with a deviation for each waypoint. It knows no camera: `path.sharp` is not looked
  /// at.
  PathMotion(const JointPath& path, const JointLimits& limits, double arc_step_rad = 0.05);
  /// The same, and no faster than `path.sharp` where there is one: the motion that arms make.
  PathMotion(const JointPath& path, const RobotModel& robot, const PathTimingOptions& options = {});
  /// The same with limits other than the robot's own, for arms that start slowly.
  PathMotion(const JointPath& path, const RobotModel& robot, const JointLimits& limits,
             const PathTimingOptions& options = {});

  [[nodiscard]] double duration_s() const { return times_s_.empty() ? 0.0 : times_s_.back(); }
  /// Position, velocity and acceleration at a time, held to [0, duration_s()].
  [[nodiscard]] Configuration at(double t_s) const;
  [[nodiscard]] Configuration velocity_at(double t_s) const;
  [[nodiscard]] Configuration acceleration_at(double t_s) const;
  [[nodiscard]] const BlendedPath& path() const { return path_; }

 private:
  PathMotion(const JointPath& path, const JointLimits& limits, const ImageMotion* image,
             const PathTimingOptions& options);
  void time_path(const TimingGrid& grid);
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
