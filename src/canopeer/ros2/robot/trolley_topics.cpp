#include "canopeer/ros2/robot/trolley_topics.h"

#include <algorithm>
#include <cmath>

namespace canopeer::ros {
namespace {

builtin_interfaces::Duration duration_of(double s) {
  const auto whole = std::floor(s);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>((s - whole) * 1e9)};
}

/// From rest to rest along a cubic, whose speed is half as high again as its mean.
double time_for(const Joint& axis, double distance) {
  return std::max({0.05, 1.5 * std::abs(distance) / axis.velocity_limit,
                   std::sqrt(6.0 * std::abs(distance) / axis.acceleration_limit)});
}

}  // namespace

Expected<std::unique_ptr<TrolleyTopics>> TrolleyTopics::make(Node& node,
                                                             const Ros2TrolleySettings& names,
                                                             const RobotModel& robot,
                                                             TrajectoryServer& trolley) {
  std::unique_ptr<TrolleyTopics> topics(new TrolleyTopics(robot, trolley));
  if (auto ok = topics->join(node, names); !ok) return tl::unexpected(ok.error());
  return topics;
}

TrolleyTopics::TrolleyTopics(const RobotModel& robot, TrajectoryServer& trolley)
    : robot_(robot),
      axes_(robot),
      trolley_(trolley),
      goal_(axes_.state(trolley.actual().position)) {}

Expected<void> TrolleyTopics::join(Node& node, const Ros2TrolleySettings& names) {
  Expected<void> outcome;
  const auto hear = [&]<class Message>(const std::string& topic, auto what) {
    if (topic.empty() || !outcome) return;
    auto heard =
        node.subscribe<Message>(topic, kDefaultQos, [this, what](Message&& message, const Guid&) {
          TrolleyState goal;
          {
            const std::scoped_lock lock(mutex_);
            what(message, goal_);
            goal = goal_;
          }
          go_to(goal);
        });
    if (heard) {
      heard_.push_back(std::move(*heard));
    } else {
      outcome = tl::unexpected(heard.error());
    }
  };
  const auto say = [&](Publisher<std_msgs::Float64>& publisher, const std::string& topic) {
    if (topic.empty() || !outcome) return;
    auto made = node.advertise<std_msgs::Float64>(topic);
    if (made) publisher = std::move(*made);
    if (!made) outcome = tl::unexpected(made.error());
  };
  using std_msgs::Float64;
  using std_msgs::Float64MultiArray;
  hear.operator()<Float64>(names.travel_command,
                           [](const Float64& m, TrolleyState& s) { s.travel_m = m.data; });
  hear.operator()<Float64>(names.lift_command,
                           [](const Float64& m, TrolleyState& s) { s.lift_m = m.data; });
  hear.operator()<Float64MultiArray>("~/push_trolley",
                                     [](const Float64MultiArray& m, TrolleyState& s) {
                                       if (!m.data.empty()) s.travel_m = m.data[0];
                                       if (m.data.size() > 1) s.lift_m = m.data[1];
                                     });
  say(travel_, names.travel_state);
  say(lift_, names.lift_state);
  return outcome;
}

void TrolleyTopics::go_to(const TrolleyState& goal) {
  const TrolleyState now = axes_.state(trolley_.actual().position);
  const double time_s = std::max(time_for(robot_.travel_axis(), goal.travel_m - now.travel_m),
                                 time_for(robot_.lift_axis(), goal.lift_m - now.lift_m));
  TrajectoryController::Goal motion;
  const Configuration end = axes_.positions(goal);
  motion.trajectory.joint_names = trolley_.joints();
  for (const double at_s : {0.0, time_s}) {
    const Configuration q = at_s == 0.0 ? trolley_.actual().position : end;
    trajectory_msgs::JointTrajectoryPoint point;
    point.positions.assign(q.data(), q.data() + q.size());
    point.velocities.assign(static_cast<std::size_t>(q.size()), 0.0);
    point.time_from_start = duration_of(at_s);
    motion.trajectory.points.push_back(point);
  }
  // A place beyond its limits: it stays.
  static_cast<void>(trolley_.move(motion));
}

void TrolleyTopics::say() {
  const TrolleyState now = axes_.state(trolley_.actual().position);
  travel_.publish({now.travel_m});
  lift_.publish({now.lift_m});
}

}  // namespace canopeer::ros
