#include "test_controller.h"

#include <algorithm>

#include "canopeer/ros2/time/stamp.h"
#include "support/must.h"

namespace canopeer::ros::testing_support {
namespace {

constexpr std::chrono::milliseconds kTick(10);
constexpr std::chrono::milliseconds kNoAnswer(800);  // is longer than anybody waits

double time_of(const trajectory_msgs::JointTrajectoryPoint& point) {
  return seconds(stamp_of({point.time_from_start.sec, point.time_from_start.nanosec}));
}

Stamp system_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

TestController::TestController(Node& node, const std::string& action,
                               std::vector<std::string> joints,
                               const std::vector<double>& positions,
                               const std::string& joint_states)
    : joints_(std::move(joints)), positions_(positions) {
  publisher_ = must(node.advertise<sensor_msgs::JointState>(joint_states));
  Server::Handlers handlers;
  handlers.accept = [this](const UUID&, const FollowJointTrajectory::Goal& goal) {
    const std::lock_guard lock(mutex_);
    return !faults_.reject && goal.trajectory.joint_names == joints_;
  };
  handlers.start = [this](const UUID& id, const FollowJointTrajectory::Goal& goal) {
    const std::lock_guard lock(mutex_);
    goal_ = goal;
    id_ = id;
    time_s_ = 0.0;
    cancelling_ = false;
    ++goals_;
  };
  handlers.cancel = [this](const UUID&) {
    ++cancels_;
    const bool answers = [&] {
      const std::lock_guard lock(mutex_);
      return cancelling_ = faults_.answers_cancel;
    }();
    if (!answers) std::this_thread::sleep_for(kNoAnswer);
    return answers;
  };
  server_ = must(Server::make(node, action, std::move(handlers)));
  thread_ = std::jthread([this](std::stop_token stop) { live(std::move(stop)); });
}

TestController::~TestController() = default;

void TestController::live(std::stop_token stop) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(kTick);
    step(0.01);
  }
}

std::vector<double> TestController::at(double t_s) const {
  const auto& points = goal_.trajectory.points;
  std::size_t next = 0;
  while (next < points.size() && time_of(points[next]) < t_s) ++next;
  if (next == points.size()) return points.back().positions;
  if (next == 0) return points.front().positions;
  const double from_s = time_of(points[next - 1]);
  const double share = (t_s - from_s) / (time_of(points[next]) - from_s);
  std::vector<double> positions = points[next - 1].positions;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] += share * (points[next].positions[i] - positions[i]);
  }
  return positions;
}

void TestController::end(GoalState state, std::int32_t code, const std::string& text) {
  server_->finish(*id_, state, {code, text});
  id_.reset();
}

void TestController::move() {
  const double whole_s = time_of(goal_.trajectory.points.back());
  const double share = time_s_ / whole_s;
  if (faults_.end_at && share >= *faults_.end_at) {
    return end(faults_.end_state, faults_.end_code, faults_.end_text);
  }
  if (cancelling_) return end(GoalState::canceled, 0, "");
  if (!faults_.freeze_at || share < *faults_.freeze_at) positions_ = at(time_s_);
  if (share < 1.0) return;
  positions_[0] += faults_.miss;
  end(GoalState::succeeded, faults_.success_code, "");
}

void TestController::step(double dt_s) {
  const std::lock_guard lock(mutex_);
  ++ticks_;
  if (id_) {
    time_s_ += dt_s * faults_.speed;
    move();
  }
  if (id_ && faults_.feedback && ticks_ % 2 == 0) {
    FollowJointTrajectory::Feedback feedback;
    feedback.joint_names = joints_;
    feedback.actual.positions = positions_;
    server_->feedback(*id_, feedback);
  }
  if (!faults_.joint_states) return;
  sensor_msgs::JointState state;
  state.header.stamp = ros_time(system_now());
  state.name = joints_;
  state.position = positions_;
  std::reverse(state.name.begin(), state.name.end());
  std::reverse(state.position.begin(), state.position.end());
  publisher_.publish(state);
}

void TestController::leave() {
  std::unique_ptr<Server> server;  // goes outside the lock, which its handlers take
  const std::lock_guard lock(mutex_);
  id_.reset();
  server = std::move(server_);
}

std::vector<double> TestController::positions() const {
  const std::lock_guard lock(mutex_);
  return positions_;
}

void TestController::put(const std::vector<double>& positions) {
  const std::lock_guard lock(mutex_);
  positions_ = positions;
}

FollowJointTrajectory::Goal TestController::last_goal() const {
  const std::lock_guard lock(mutex_);
  return goal_;
}

double TestController::progress() const {
  const std::lock_guard lock(mutex_);
  if (!id_) return 1.0;
  return time_s_ / time_of(goal_.trajectory.points.back());
}

}  // namespace canopeer::ros::testing_support
