#include "canopeer/sim/robot_track.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

constexpr double kTwistStep = 1e-3;  // s, each way

/// Along one axis; null: it does not move.
std::shared_ptr<const StraightMotion> axis_motion(const Joint& axis, double from, double to,
                                                  double max_speed) {
  if (from == to) return nullptr;
  const auto one = [](double value) { return Configuration::Constant(1, value); };
  const double speed =
      max_speed > 0.0 ? std::min(max_speed, axis.velocity_limit) : axis.velocity_limit;
  return std::make_shared<const StraightMotion>(
      one(from), one(to),
      JointLimits{one(axis.lower), one(axis.upper), one(speed), one(axis.acceleration_limit)});
}

double duration_of(const std::shared_ptr<const StraightMotion>& motion) {
  return motion ? motion->duration_s() : 0.0;
}

}  // namespace

RobotTrack::RobotTrack(const RobotModel& robot, const Configuration& q, const TrolleyState& trolley)
    : robot_(&robot), q_(q), trolley_(trolley) {}

void RobotTrack::stand(const Configuration& q, const TrolleyState& trolley) {
  q_ = q;
  trolley_ = trolley;
  arm_.reset();
  travel_.reset();
  lift_.reset();
}

void RobotTrack::move_arm(const JointPath& path, double start_s) {
  start_s_ = start_s;
  arm_ = std::make_shared<const PathMotion>(path, *robot_);
}

double RobotTrack::drive(const TrolleyState& goal, double max_travel_m_s, double start_s) {
  start_s_ = start_s;
  travel_ = axis_motion(robot_->travel_axis(), trolley_.travel_m, goal.travel_m, max_travel_m_s);
  lift_ = axis_motion(robot_->lift_axis(), trolley_.lift_m, goal.lift_m, 0.0);
  return duration_of(travel_) + duration_of(lift_);
}

Configuration RobotTrack::arm_at(double t_s) const { return arm_ ? arm_->at(t_s - start_s_) : q_; }

TrolleyState RobotTrack::trolley_at(double t_s) const {
  TrolleyState trolley = trolley_;
  const double passed_s = t_s - start_s_;
  if (travel_) trolley.travel_m = travel_->at(passed_s)[0];
  if (lift_) trolley.lift_m = lift_->at(passed_s - duration_of(travel_))[0];
  return trolley;
}

Pose RobotTrack::camera_at(double t_s) const {
  return robot_->T_world_base(trolley_at(t_s)) * robot_->T_base_camera(arm_at(t_s));
}

CameraTwist RobotTrack::twist_at(double t_s) const {
  return twist_between(camera_at(t_s - kTwistStep), camera_at(t_s + kTwistStep), 2 * kTwistStep);
}

}  // namespace canopeer
