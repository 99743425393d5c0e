#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/dds/action.h"
#include "canopeer/ros2/arm/trajectory_goal.h"

namespace canopeer::ros::testing_support {

/// What goes wrong with a controller.
struct ControllerFaults {
  bool reject = false;
  std::optional<double> end_at;  ///< the share of a motion, 0 … 1, at which it ends, with:
  GoalState end_state = GoalState::aborted;
  std::int32_t end_code = 0;
  std::string end_text;
  std::optional<double> freeze_at;  ///< the share of a motion at which the joints stand still
  double speed = 1.0;               ///< of the trajectory's time: what a pendant does
  double miss = 0.0;                ///< the first joint ends beside its goal, rad
  bool feedback = true;
  bool joint_states = true;
  bool answers_cancel = true;
  std::int32_t success_code = 0;
};

/// A controller behind a real action server, and the joints that it moves, with joint states at 100
/// Hz and feedback at 50 Hz.
class TestController {
 public:
  TestController(Node& node, const std::string& action, std::vector<std::string> joints,
                 const std::vector<double>& positions,
                 const std::string& joint_states = "/joint_states");
  ~TestController();

  /// Changes what goes wrong.
  template <class Change>
  void faults(Change change) {
    const std::lock_guard lock(mutex_);
    change(faults_);
  }
  /// The action is gone, in mid-motion too; joint states go on.
  void leave();
  [[nodiscard]] std::vector<double> positions() const;
  void put(const std::vector<double>& positions);
  [[nodiscard]] int goals() const { return goals_; }
  [[nodiscard]] int cancels() const { return cancels_; }
  [[nodiscard]] FollowJointTrajectory::Goal last_goal() const;
  /// Share of the motion under way; 1: none is.
  [[nodiscard]] double progress() const;

 private:
  using Server = ActionServer<FollowJointTrajectory>;
  void live(std::stop_token stop);
  void step(double dt_s);
  void move();
  [[nodiscard]] std::vector<double> at(double t_s) const;
  void end(GoalState state, std::int32_t code, const std::string& text);

  const std::vector<std::string> joints_;
  mutable std::mutex mutex_;
  ControllerFaults faults_;
  std::vector<double> positions_;
  FollowJointTrajectory::Goal goal_;
  std::optional<UUID> id_;
  double time_s_ = 0.0;
  bool cancelling_ = false;
  std::atomic<int> goals_{0};
  std::atomic<int> cancels_{0};
  std::int64_t ticks_ = 0;
  Publisher<sensor_msgs::JointState> publisher_;
  std::unique_ptr<Server> server_;
  std::jthread thread_;
};

}  // namespace canopeer::ros::testing_support
