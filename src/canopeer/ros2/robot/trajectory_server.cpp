#include "canopeer/ros2/robot/trajectory_server.h"

#include <utility>

namespace canopeer::ros {

TrajectoryServer::TrajectoryServer(TrajectoryController controller, RobotFaults& faults,
                                   bool of_arm)
    : controller_(std::move(controller)), faults_(faults), of_arm_(of_arm) {}

Expected<void> TrajectoryServer::serve(Node& node, const std::string& action) {
  auto server = ActionServer<Action>::make(
      node, action,
      {[this](const UUID&, const Action::Goal& goal) { return accept(goal); },
       [this](const UUID& id, const Action::Goal& goal) { start(id, goal); },
       [this](const UUID& id) { return cancel(id); },
       [this] { return faults_.on(RobotFault::vanish); }});
  if (!server) return tl::unexpected(server.error());
  server_ = std::move(*server);
  return {};
}

bool TrajectoryServer::accept(const Action::Goal& goal) {
  if (of_arm_) faults_.begin_motion();
  const std::scoped_lock lock(mutex_);
  ++counts_.goals;
  const bool accepted = controller_.check(goal).has_value();
  if (!accepted) ++counts_.refused;
  return accepted;
}

void TrajectoryServer::start(const UUID& id, const Action::Goal& goal) {
  const std::scoped_lock lock(mutex_);
  if (auto before = controller_.begin(id, goal)) ends_.push_back(std::move(*before));
}

bool TrajectoryServer::cancel(const UUID& id) {
  const std::scoped_lock lock(mutex_);
  return controller_.cancel(id);
}

Expected<void> TrajectoryServer::move(const TrajectoryController::Goal& goal) {
  const std::scoped_lock lock(mutex_);
  if (auto ok = controller_.check(goal); !ok) return ok;
  if (auto before = controller_.begin({}, goal)) ends_.push_back(std::move(*before));
  return {};
}

void TrajectoryServer::tick(double dt_s, bool with_feedback,
                            const builtin_interfaces::Time& stamp) {
  std::vector<GoalEnd> ends;
  std::optional<UUID> goal;
  TrajectoryController::Feedback feedback;
  {
    const std::scoped_lock lock(mutex_);
    ends.swap(ends_);
    if (auto ended = controller_.tick(dt_s)) ends.push_back(std::move(*ended));
    for (const GoalEnd& end : ends) {
      ++(end.state == GoalState::succeeded ? counts_.arrived : counts_.cut_short);
    }
    goal = controller_.goal();
    if (with_feedback && goal) feedback = controller_.feedback();
  }
  if (server_ == nullptr) return;
  if (with_feedback && goal && !faults_.on(RobotFault::no_feedback)) {
    feedback.header.stamp = stamp;
    server_->feedback(*goal, feedback);
  }
  for (const GoalEnd& end : ends) {
    if (end.goal == UUID{}) continue;  // of move()
    Action::Result result;
    result.error_code = end.code;
    result.error_string = end.why;
    server_->finish(end.goal, end.state, result);
  }
}

void TrajectoryServer::release() {
  const std::scoped_lock lock(mutex_);
  controller_.release();
}

JointsState TrajectoryServer::actual() const {
  const std::scoped_lock lock(mutex_);
  return controller_.actual();
}

bool TrajectoryServer::moving() const {
  const std::scoped_lock lock(mutex_);
  return controller_.goal().has_value() ||
         controller_.actual().velocity.cwiseAbs().maxCoeff() > 1e-3;
}

bool TrajectoryServer::stopped() const {
  const std::scoped_lock lock(mutex_);
  return controller_.stopped();
}

double TrajectoryServer::speed_scale() const {
  const std::scoped_lock lock(mutex_);
  return controller_.speed_scale();
}

TrajectoryServer::Counts TrajectoryServer::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

}  // namespace canopeer::ros
