#include "canopeer/ros2/robot/trajectory_controller.h"

#include <algorithm>
#include <cmath>

namespace canopeer::ros {
namespace {

using Result = control_msgs::FollowJointTrajectory::Result;
using control_msgs::JointTolerance;

/// 0 means the controller's own, less that there is none.
void apply_tolerances(const std::vector<JointTolerance>& given,
                      const std::vector<std::string>& joints, Configuration& tolerances) {
  for (const JointTolerance& t : given) {
    const auto found = std::find(joints.begin(), joints.end(), t.name);
    if (found == joints.end() || t.position == 0.0) continue;
    tolerances[found - joints.begin()] =
        t.position < 0.0 ? std::numeric_limits<double>::infinity() : t.position;
  }
}

/// The joint that is farthest beyond its tolerance; −1: none.
Eigen::Index beyond(const Configuration& error, const Configuration& tolerance) {
  Eigen::Index worst = -1;
  double excess = 0.0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double e = std::abs(error[i]) - tolerance[i];
    if (e > excess) {
      excess = e;
      worst = i;
    }
  }
  return worst;
}

std::vector<double> numbers(const Configuration& q) { return {q.data(), q.data() + q.size()}; }

trajectory_msgs::JointTrajectoryPoint point_of(const JointsState& state) {
  trajectory_msgs::JointTrajectoryPoint point;
  point.positions = numbers(state.position);
  point.velocities = numbers(state.velocity);
  return point;
}

}  // namespace

TrajectoryController::TrajectoryController(ControllerOptions options, const Configuration& start,
                                           RobotFaults* faults)
    : options_(std::move(options)),
      faults_(faults),
      curve_(JointCurve::standing(start)),
      aside_(Configuration::Zero(start.size())),
      desired_(curve_.at(0.0)),
      actual_(desired_) {}

Expected<JointCurve> TrajectoryController::curve_of(const Goal& goal) const {
  return JointCurve::make(goal.trajectory, options_.joints, desired_);
}

Expected<void> TrajectoryController::check(const Goal& goal) const {
  if (stopped_) return fail("the controller is not running: protective stop");
  if (faults_ != nullptr && faults_->on(RobotFault::reject)) {
    faults_->happened(RobotFault::reject);
    return fail("refused, as asked for");
  }
  const auto curve = curve_of(goal);
  if (!curve) return tl::unexpected(curve.error());
  const Configuration away = (curve->first() - actual_.position).cwiseAbs();
  Eigen::Index joint = 0;
  if (away.maxCoeff(&joint) > options_.start_tolerance) {
    return fail("joint '" + options_.joints[static_cast<std::size_t>(joint)] + "' is " +
                std::to_string(away[joint]) + " away from where the trajectory begins");
  }
  const Configuration last = curve->at(curve->duration_s()).position;
  for (Eigen::Index i = 0; i < last.size(); ++i) {
    if (last[i] < options_.lower[i] - 1e-6 || last[i] > options_.upper[i] + 1e-6) {
      return fail("the goal is beyond the limits of joint '" +
                  options_.joints[static_cast<std::size_t>(i)] + "'");
    }
  }
  return {};
}

TrajectoryController::Tolerances TrajectoryController::tolerances_of(const Goal& goal) const {
  const auto n = static_cast<Eigen::Index>(options_.joints.size());
  Tolerances tolerances{Configuration::Constant(n, options_.path_tolerance),
                        Configuration::Constant(n, options_.goal_tolerance),
                        goal.goal_time_tolerance.sec + goal.goal_time_tolerance.nanosec * 1e-9};
  apply_tolerances(goal.path_tolerance, options_.joints, tolerances.path);
  apply_tolerances(goal.goal_tolerance, options_.joints, tolerances.goal);
  return tolerances;
}

std::optional<GoalEnd> TrajectoryController::begin(const UUID& id, const Goal& goal) {
  std::optional<GoalEnd> before;
  if (id_) {
    before = end(GoalState::canceled, Result::INVALID_GOAL,
                 "Current goal cancelled due to new incoming action.");
  }
  auto curve = curve_of(goal);
  if (!curve) return before;  // the joints have moved on since it was checked, no more
  curve_ = std::move(*curve);
  time_s_ = 0.0;
  braking_ = canceling_ = held_back_ = false;
  brake_ = 1.0;
  aside_.setZero();
  tolerances_ = tolerances_of(goal);
  id_ = id;
  return before;
}

bool TrajectoryController::cancel(const UUID& id) {
  if (!id_ || id_->uuid != id.uuid) return false;
  braking_ = canceling_ = true;
  return true;
}

double TrajectoryController::speed_scale() const {
  if (stopped_) return 0.0;
  const auto slow = faults_ != nullptr ? faults_->values(RobotFault::slow) : std::nullopt;
  return slow ? std::clamp((*slow)[0], 0.0, 1.0) : 1.0;
}

void TrajectoryController::advance(double dt_s) {
  if (braking_) brake_ = std::max(0.0, brake_ - dt_s / options_.brake_s);
  const double scale = speed_scale() * brake_;
  time_s_ += dt_s * scale;
  desired_ = curve_.at(time_s_);
  desired_.velocity *= scale;
  if (braking_ && brake_ == 0.0) {
    curve_ = JointCurve::standing(desired_.position);
    braking_ = false;
  }
  const Configuration before = actual_.position;
  if (!held_back_) {
    const double followed = 1.0 - std::exp(-dt_s / options_.lag_s);
    actual_.position += followed * (desired_.position + aside_ - actual_.position);
  }
  actual_.velocity = dt_s > 0.0 ? Configuration((actual_.position - before) / dt_s)
                                : Configuration(Configuration::Zero(before.size()));
}

std::optional<GoalEnd> TrajectoryController::tick(double dt_s) {
  advance(dt_s);
  if (!id_) return {};
  if (canceling_) {
    if (braking_) return {};
    return end(GoalState::canceled, Result::SUCCESSFUL, "cancelled");
  }
  if (auto injected = injected_end()) return injected;
  return regular_end();
}

/// The values of a fault whose share of the motion is over.
std::optional<std::array<double, 2>> TrajectoryController::due(RobotFault fault) const {
  const auto values = faults_->values(fault);
  if (!values || time_s_ < (*values)[0] * curve_.duration_s()) return {};
  return values;
}

std::optional<GoalEnd> TrajectoryController::injected_end() {
  if (faults_ == nullptr) return {};
  if (due(RobotFault::abort)) {
    faults_->happened(RobotFault::abort);
    braking_ = true;
    return end(GoalState::aborted, Result::SUCCESSFUL, "aborted, as asked for");
  }
  if (due(RobotFault::preempt)) {
    faults_->happened(RobotFault::preempt);
    braking_ = true;
    return end(GoalState::canceled, Result::INVALID_GOAL,
               "Current goal cancelled due to new incoming action.");
  }
  if (due(RobotFault::protective_stop)) {
    faults_->happened(RobotFault::protective_stop);
    stopped_ = true;
    stand_where_it_is();
    return end(GoalState::canceled, Result::INVALID_GOAL,
               "Current goal cancelled during deactivate transition.");
  }
  if (due(RobotFault::path_tolerance)) held_back_ = true;
  if (const auto missed = faults_->values(RobotFault::goal_missed)) {
    const double share = curve_.duration_s() > 0.0 ? time_s_ / curve_.duration_s() : 1.0;
    aside_[0] = (*missed)[0] * std::min(share, 1.0);
  }
  return {};
}

std::optional<GoalEnd> TrajectoryController::regular_end() {
  const auto name = [&](Eigen::Index joint) {
    return options_.joints[static_cast<std::size_t>(joint)];
  };
  if (time_s_ < curve_.duration_s()) {
    const Eigen::Index joint =
        beyond(actual_.position - aside_ - desired_.position, tolerances_.path);
    if (joint < 0) return {};
    if (held_back_) faults_->happened(RobotFault::path_tolerance);
    held_back_ = false;
    stand_where_it_is();
    return end(GoalState::aborted, Result::PATH_TOLERANCE_VIOLATED,
               "Aborted due to path tolerance violation: joint '" + name(joint) + "'");
  }
  const bool as_asked = faults_ != nullptr && faults_->on(RobotFault::no_result);
  const bool missing = faults_ != nullptr && faults_->on(RobotFault::goal_missed);
  const Configuration goal = desired_.position + aside_;
  // At rest, as drives are when they say so.
  if ((actual_.position - goal).cwiseAbs().maxCoeff() < 1e-4 && !held_back_) {
    if (as_asked) {
      faults_->happened(RobotFault::no_result);
      id_.reset();
      return {};
    }
    if (missing) faults_->happened(RobotFault::goal_missed);
    return end(GoalState::succeeded, Result::SUCCESSFUL, "Goal successfully reached!");
  }
  const double over_s = time_s_ - curve_.duration_s();
  const Eigen::Index joint = beyond(actual_.position - desired_.position, tolerances_.goal);
  if (joint < 0 || tolerances_.goal_time_s <= 0.0 || over_s < tolerances_.goal_time_s) return {};
  if (held_back_) faults_->happened(RobotFault::path_tolerance);
  held_back_ = false;
  stand_where_it_is();
  return end(GoalState::aborted, Result::GOAL_TOLERANCE_VIOLATED,
             "Aborted due to goal_time_tolerance exceeding: joint '" + name(joint) + "'");
}

GoalEnd TrajectoryController::end(GoalState state, std::int32_t code, std::string why) {
  GoalEnd ended{*id_, state, code, std::move(why)};
  id_.reset();
  canceling_ = false;
  return ended;
}

void TrajectoryController::stand_where_it_is() {
  curve_ = JointCurve::standing(actual_.position);
  desired_ = curve_.at(0.0);
  time_s_ = 0.0;
  aside_.setZero();
}

TrajectoryController::Feedback TrajectoryController::feedback() const {
  Feedback feedback;
  feedback.joint_names = options_.joints;
  feedback.desired = point_of(desired_);
  feedback.actual = point_of(actual_);
  feedback.error =
      point_of({desired_.position - actual_.position, desired_.velocity - actual_.velocity});
  return feedback;
}

}  // namespace canopeer::ros
