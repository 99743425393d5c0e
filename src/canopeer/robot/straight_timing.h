#pragma once

#include <optional>

#include "canopeer/robot/joint_path.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// Minimum-time straight motion in joint space between two standstills: q(t) = from + s(t)·Δ, s
/// from 0 to 1. Under |Δ_i|·ṡ ≤ v_i and |Δ_i|·|s̈| ≤ a_i that is a trapezoid (or triangle) in ṡ.
class StraightMotion {
 public:
  StraightMotion(const Configuration& from, const Configuration& to, const JointLimits& limits);

  [[nodiscard]] double duration_s() const { return duration_s_; }
  /// Position at time t; before 0 the start, after the end the goal.
  [[nodiscard]] Configuration at(double t_s) const;
  /// Fraction of the line travelled at time t, 0 … 1.
  [[nodiscard]] double fraction_at(double t_s) const;
  [[nodiscard]] const Configuration& from() const { return from_; }
  [[nodiscard]] const Configuration& to() const { return to_; }

 private:
  Configuration from_;
  Configuration to_;
  double rate_ = 0.0;          // highest ṡ reached, 1/s
  double acceleration_ = 0.0;  // s̈ while speeding up, 1/s²
  double duration_s_ = 0.0;
};

/// Duration of StraightMotion(a, b, limits), without making one, s.
[[nodiscard]] double motion_time(const Configuration& a, const Configuration& b,
                                 const JointLimits& limits);

/// About how long the straight motion takes that keeps to `sharp` too, s: PathMotion's time to a
/// few per cent, from nine looks at the camera. Exactly motion_time() without `sharp`, or where it
/// limits nothing. Allocates nothing.
[[nodiscard]] double straight_motion_time(const Configuration& a, const Configuration& b,
                                          const RobotModel& robot,
                                          const std::optional<ImageMotionLimit>& sharp);

/// The time of motion_time() for one axis (the trolley's), distance in m or rad, s.
[[nodiscard]] double axis_motion_time(double distance, double velocity_limit,
                                      double acceleration_limit);

}  // namespace canopeer
