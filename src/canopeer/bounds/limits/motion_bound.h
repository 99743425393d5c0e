#pragma once

#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// How long the arm needs at least, by the limits of each joint alone: true for any path, rounded
/// or not, since the slowest joint has to make its own way. From standing to standing joint i needs
/// 2√(Δ/a), or Δ/v + v/a where it reaches v. Both this and Δ/v are metrics of configurations, so
/// what a planner does between two looks (other stops, detours) takes no less than the straight
/// bound between them.
class MotionBound {
 public:
  /// `on_the_way`: frames are taken while the arm moves, so views need no standing still.
  /// `robot` outlives it.
  MotionBound(const RobotModel& robot, bool on_the_way);

  /// From one look to another, s.
  [[nodiscard]] double between(const Configuration& a, const Configuration& b) const {
    return on_the_way_ ? slowest(a, b, passing) : slowest(a, b, stop_to_stop);
  }
  /// From standing at `home` to a look, s.
  [[nodiscard]] double first(const Configuration& home, const Configuration& b) const {
    return on_the_way_ ? slowest(home, b, start_to_pass) : slowest(home, b, stop_to_stop);
  }
  /// The same when joint i turns by no less than delta[i] ≥ 0.
  [[nodiscard]] double first(const Configuration& delta) const;
  /// How far joint i can have turned `time_s` after standing, by a look: the inverse of first().
  [[nodiscard]] double most_turn(int joint, double time_s) const;

  // Of one joint, by how far it turns, its speed and acceleration.
  static double stop_to_stop(double delta, double v, double a);
  static double start_to_pass(double delta, double v, double a);
  static double passing(double delta, double v, double) { return delta / v; }

 private:
  using OneJoint = double (*)(double, double, double);
  [[nodiscard]] double slowest(const Configuration& a, const Configuration& b,
                               OneJoint time_of) const;

  const RobotModel& robot_;
  bool on_the_way_;
  bool alike_;  // all joints have the same limits: the longest way is the slowest
};

}  // namespace canopeer
