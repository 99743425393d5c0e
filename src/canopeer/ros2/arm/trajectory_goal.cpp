#include "canopeer/ros2/arm/trajectory_goal.h"

#include <algorithm>
#include <cmath>

#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {
namespace {

constexpr double kWholeTurn = 6.283185307179586;
constexpr double kMakeUp_s = 0.5;        // at least, for where the arm stands beside its path
constexpr double kFastestFade = 1.875;   // the greatest rate of a fade of a second
constexpr double kStrongestFade = 5.78;  // the greatest acceleration
constexpr double kNoGap = 1e-6;
constexpr int kMostPoints = 20000;

/// Goes from 1 to 0 in the time `T`, from standstill to standstill: value, rate, its rate.
struct Fade {
  double value = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;
};
Fade fade(double t_s, double T) {
  if (t_s >= T) return {};
  const double u = t_s / T;
  return {1.0 - u * u * u * (10.0 - u * (15.0 - 6.0 * u)),
          -30.0 * u * u * (1.0 - u) * (1.0 - u) / T,
          -60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (T * T)};
}

/// How long making up takes, so that no joint is faster for it than its limits.
double make_up_s(const Configuration& gap, const JointLimits& limits) {
  double time_s = kMakeUp_s;
  for (Eigen::Index i = 0; i < std::min(gap.size(), limits.velocity.size()); ++i) {
    const double way = std::abs(gap[i]);
    time_s = std::max({time_s, kFastestFade * way / limits.velocity[i],
                       std::sqrt(kStrongestFade * way / limits.acceleration[i])});
  }
  return time_s;
}

builtin_interfaces::Duration duration_of(double wanted_s) {
  const builtin_interfaces::Time time = ros_time(nanoseconds(wanted_s));
  return {time.sec, time.nanosec};
}

std::vector<double> numbers(const Configuration& q) { return {q.data(), q.data() + q.size()}; }

std::vector<control_msgs::JointTolerance> tolerances(const std::vector<std::string>& joints,
                                                     double position) {
  std::vector<control_msgs::JointTolerance> all;
  if (position <= 0.0) return all;
  for (const std::string& joint : joints) all.push_back({joint, position, 0.0, 0.0});
  return all;
}

}  // namespace

FollowJointTrajectory::Goal trajectory_goal(const PathMotion& motion,
                                            const std::vector<std::string>& joints,
                                            const Configuration& stands,
                                            const EndlessJoints& endless,
                                            const TrajectoryOptions& options) {
  const Configuration begin = motion.at(0.0);
  Configuration turns = Configuration::Zero(begin.size());
  for (Eigen::Index i = 0; i < begin.size(); ++i) {
    if (endless[static_cast<int>(i)]) {
      turns[i] = kWholeTurn * std::round((stands[i] - begin[i]) / kWholeTurn);
    }
  }
  const Configuration gap = stands - begin - turns;
  const bool beside = gap.lpNorm<Eigen::Infinity>() > kNoGap;
  const double fade_s = make_up_s(gap, options.limits);
  const double end_s = std::max(motion.duration_s(), beside ? fade_s : 1.0 / options.rate_hz);
  const int steps =
      std::clamp(static_cast<int>(std::ceil(end_s * options.rate_hz)), 1, kMostPoints - 1);

  FollowJointTrajectory::Goal goal;
  goal.trajectory.joint_names = joints;
  goal.trajectory.points.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i) {
    const double t_s = i == steps ? end_s : end_s * i / steps;
    const Fade left = fade(t_s, fade_s);
    trajectory_msgs::JointTrajectoryPoint point;
    point.positions = numbers(motion.at(t_s) + turns + left.value * gap);
    Configuration velocity = motion.velocity_at(t_s) + left.rate * gap;
    Configuration acceleration = motion.acceleration_at(t_s) + left.acceleration * gap;
    if (t_s >= motion.duration_s()) {  // it stands then
      velocity = left.rate * gap;
      acceleration = left.acceleration * gap;
    }
    point.velocities = numbers(velocity);
    point.accelerations = numbers(acceleration);
    point.time_from_start = duration_of(t_s);
    goal.trajectory.points.push_back(std::move(point));
  }
  goal.path_tolerance = tolerances(joints, options.path_tolerance);
  goal.goal_tolerance = tolerances(joints, options.goal_tolerance);
  goal.goal_time_tolerance = duration_of(options.goal_time_tolerance_s);
  return goal;
}

double duration_s(const FollowJointTrajectory::Goal& goal) {
  if (goal.trajectory.points.empty()) return 0.0;
  const auto& time = goal.trajectory.points.back().time_from_start;
  return seconds(stamp_of({time.sec, time.nanosec}));
}

Configuration end_of(const FollowJointTrajectory::Goal& goal) {
  const std::vector<double>& end = goal.trajectory.points.back().positions;
  return Eigen::Map<const Eigen::VectorXd>(end.data(), static_cast<Eigen::Index>(end.size()));
}

}  // namespace canopeer::ros
