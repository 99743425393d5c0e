#pragma once

#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/trajectory_msgs.h"
#include "canopeer/robot/configuration.h"

namespace canopeer::ros {

/// Where joints are and how fast they move: rad and rad/s, or m and m/s.
struct JointsState {
  Configuration position;
  Configuration velocity;
};

/// A trajectory between its points, as the joint trajectory controller of ros2_control has it:
/// straight lines where points have positions only, cubics where they have velocities too. Before
/// the first point it comes from where the joints were.
class JointCurve {
 public:
  /// `names`: the joints, in the order of `now`; the trajectory may have any order. The error: what
  /// such a controller refuses a trajectory for, in its words.
  [[nodiscard]] static Expected<JointCurve> make(const trajectory_msgs::JointTrajectory& trajectory,
                                                 const std::vector<std::string>& names,
                                                 const JointsState& now);
  /// Stays at one place.
  [[nodiscard]] static JointCurve standing(const Configuration& q);

  [[nodiscard]] double duration_s() const { return knots_.back().time_s; }
  /// Held to [0, duration_s()]; standing still behind the end.
  [[nodiscard]] JointsState at(double time_s) const;
  /// Where the first point of the trajectory is.
  [[nodiscard]] const Configuration& first() const { return first_; }

 private:
  struct Knot {
    double time_s = 0.0;
    JointsState state;
    bool with_velocity = false;
  };
  std::vector<Knot> knots_;
  Configuration first_;
};

}  // namespace canopeer::ros
