#include "canopeer/bounds/limits/motion_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canopeer {

MotionBound::MotionBound(const RobotModel& robot, bool on_the_way)
    : robot_(robot), on_the_way_(on_the_way) {
  const JointLimits& limits = robot.limits();
  alike_ = limits.velocity.minCoeff() == limits.velocity.maxCoeff() &&
           limits.acceleration.minCoeff() == limits.acceleration.maxCoeff();
}

double MotionBound::stop_to_stop(double delta, double v, double a) {
  return delta * a < v * v ? 2.0 * std::sqrt(delta / a) : delta / v + v / a;
}

double MotionBound::start_to_pass(double delta, double v, double a) {
  return 2.0 * delta * a < v * v ? std::sqrt(2.0 * delta / a) : delta / v + 0.5 * v / a;
}

double MotionBound::slowest(const Configuration& a, const Configuration& b,
                            OneJoint time_of) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const JointLimits& limits = robot_.limits();
  const EndlessJoints& endless = robot_.endless();
  double longest = 0.0;
  double time_s = 0.0;
  for (int i = 0; i < a.size(); ++i) {
    double delta = std::abs(b[i] - a[i]);
    if (endless[i]) delta = std::abs(delta - kTurn * std::round(delta / kTurn));
    if (alike_) {
      longest = std::max(longest, delta);
    } else {
      time_s = std::max(time_s, time_of(delta, limits.velocity[i], limits.acceleration[i]));
    }
  }
  return alike_ ? time_of(longest, limits.velocity[0], limits.acceleration[0]) : time_s;
}

double MotionBound::first(const Configuration& delta) const {
  const JointLimits& limits = robot_.limits();
  double time_s = 0.0;
  for (int i = 0; i < delta.size(); ++i) {
    time_s = std::max(time_s, (on_the_way_ ? start_to_pass : stop_to_stop)(
                                  delta[i], limits.velocity[i], limits.acceleration[i]));
  }
  return time_s;
}

double MotionBound::most_turn(int joint, double time_s) const {
  const double v = robot_.limits().velocity[joint];
  const double a = robot_.limits().acceleration[joint];
  if (on_the_way_) {
    return time_s < v / a ? 0.5 * a * time_s * time_s : v * time_s - 0.5 * v * v / a;
  }
  return time_s < 2.0 * v / a ? 0.25 * a * time_s * time_s : v * time_s - v * v / a;
}

}  // namespace canopeer
