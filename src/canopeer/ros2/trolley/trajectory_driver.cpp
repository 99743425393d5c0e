#include "canopeer/ros2/trolley/trajectory_driver.h"

#include <algorithm>
#include <utility>

#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/arm/motion_ending.h"
#include "canopeer/ros2/arm/trajectory_client.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr double kPatience = 1.5;   // a slow drive may take so many times as long as planned
constexpr double kSpeedUp_s = 1.0;  // to the highest speed, where the URDF gives no acceleration

class TrajectoryDriver : public TrolleyDriver {
 public:
  TrajectoryDriver(const TrolleyParts& parts, const Ros2Settings& settings,
                   std::unique_ptr<TrajectoryClient> client)
      : parts_(parts),
        settings_(settings.trolley),
        max_silence_s_(settings.arm.max_silence_s),
        client_(std::move(client)) {
    add_axis(parts_.robot.setup().travel_joint, parts_.robot.travel_axis(), settings);
    add_axis(parts_.robot.setup().lift_joint, parts_.robot.lift_axis(), settings);
    const auto count = static_cast<Eigen::Index>(axes_.size());
    limits_.velocity = Eigen::Map<Eigen::VectorXd>(velocity_.data(), count);
    limits_.acceleration = Eigen::Map<Eigen::VectorXd>(acceleration_.data(), count);
  }

  std::vector<std::string> missing() const override {
    if (client_->ready()) return {};
    return {"action " + client_->action() +
            " (control_msgs/action/FollowJointTrajectory, ros2.trolley.action)"};
  }
  bool at(const TrolleyState& goal) const override {
    return stands_at(parts_.sense.now(), goal, settings_.tolerance_m);
  }
  Expected<void> drive(const TrolleyState& goal) override {
    if (auto started = start(goal, 0.0); !started) return tl::unexpected(started.error());
    return finish();
  }
  Expected<double> start(const TrolleyState& goal, double max_travel_m_s) override;
  Expected<void> finish() override;

 private:
  void add_axis(const std::string& joint, const Joint& axis, const Ros2Settings& settings) {
    if (joint.empty()) return;
    axes_.push_back(drivers_name(settings.arm.joint_names, joint));
    const double speed = axis.velocity_limit > 0.0
                             ? std::min(settings_.speed_m_s, axis.velocity_limit)
                             : settings_.speed_m_s;
    velocity_.push_back(speed);
    acceleration_.push_back(axis.acceleration_limit > 0.0
                                ? std::min(axis.acceleration_limit, speed / kSpeedUp_s)
                                : speed / kSpeedUp_s);
  }
  Configuration positions(const TrolleyState& state) const {
    std::vector<double> values;
    if (!parts_.robot.setup().travel_joint.empty()) values.push_back(state.travel_m);
    if (!parts_.robot.setup().lift_joint.empty()) values.push_back(state.lift_m);
    return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  JointLimits limits_for(double max_travel_m_s) const {
    JointLimits limits = limits_;
    if (max_travel_m_s > 0.0 && !parts_.robot.setup().travel_joint.empty()) {
      limits.velocity[0] = std::min(limits.velocity[0], max_travel_m_s);
    }
    return limits;
  }

  TrolleyParts parts_;
  Ros2TrolleySettings settings_;
  double max_silence_s_;
  std::unique_ptr<TrajectoryClient> client_;
  std::vector<std::string> axes_;  // the driver's names
  std::vector<double> velocity_;
  std::vector<double> acceleration_;
  JointLimits limits_;
  // Of the drive under way:
  TrolleyState goal_;
  double duration_s_ = 0.0;
};

Expected<double> TrajectoryDriver::start(const TrolleyState& goal, double max_travel_m_s) {
  if (axes_.empty()) return fail("the robot's URDF has no axes for it");
  if (auto ok = parts_.alive(max_silence_s_); !ok) return tl::unexpected(ok.error());
  const Configuration from = positions(parts_.sense.now());
  const PathMotion motion(std::vector<Configuration>{from, positions(goal)},
                          limits_for(max_travel_m_s));
  const auto accepted =
      client_->send(trajectory_goal(motion, axes_, from, EndlessJoints(), {20.0, 0.0, 0.0, 0.0}));
  if (!accepted) return fail_in("lost " + client_->action(), accepted.error());
  if (!*accepted) return fail(client_->action() + " refuses to drive; its log says why");
  goal_ = goal;
  duration_s_ = motion.duration_s();
  return duration_s_;
}

Expected<void> TrajectoryDriver::finish() {
  GoalWatch watch;
  watch.alive = [this] { return parts_.alive(max_silence_s_); };
  watch.cancel = [&]() -> std::optional<std::string> {
    if (!parts_.person.stop()) return std::nullopt;
    return "the run is to stop";
  };
  watch.longest_s = std::max(settings_.timeout_s, kPatience * duration_s_);
  const auto ending = client_->finish(watch);
  if (!ending) return tl::unexpected(ending.error());
  if (parts_.person.stop()) return {};
  if (ending->cancelled) return fail("cancelled: " + *ending->cancelled);
  if (ending->state != GoalState::succeeded) {
    return fail("it did not arrive: " + in_words(ending->result));
  }
  // Where it stands is said a little later than that it arrived.
  for (int wait = 0; wait < 100 && !at(goal_); ++wait) {
    if (auto ok = parts_.alive(max_silence_s_); !ok) return ok;
    parts_.clock.sleep(0.01);
  }
  if (at(goal_)) return {};
  return fail("it is said to have arrived, but stands at " +
              in_words(parts_.sense.now(), parts_.robot) + " (ros2.trolley.tolerance_m)");
}

}  // namespace

Expected<std::unique_ptr<TrolleyDriver>> make_trajectory_driver(const TrolleyParts& parts,
                                                                const Ros2Settings& settings) {
  auto client = TrajectoryClient::make(parts.node, settings.trolley.action);
  if (!client) return tl::unexpected(client.error());
  return std::make_unique<TrajectoryDriver>(parts, settings, std::move(*client));
}

}  // namespace canopeer::ros
