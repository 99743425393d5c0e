#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "canopeer/ros2/robot/robot_clock.h"
#include "canopeer/ros2/robot/trajectory_controller.h"

namespace canopeer::ros {

/// A controller behind its action, FollowJointTrajectory.
class TrajectoryServer {
 public:
  struct Counts {
    int goals = 0;
    int refused = 0;
    int arrived = 0;
    int cut_short = 0;  ///< aborted, cancelled, preempted
  };
  /// What it refers to outlives the server. `of_arm`: faults of motions happen to it.
  TrajectoryServer(TrajectoryController controller, RobotFaults& faults, bool of_arm);
  [[nodiscard]] Expected<void> serve(Node& node, const std::string& action);

  /// Time passes; called by one thread. The controller moves, and what there is to say is said.
  void tick(double dt_s, bool with_feedback, const builtin_interfaces::Time& stamp);
  /// A motion from outside the action, as by a person or a fieldbus. The error: it is refused.
  [[nodiscard]] Expected<void> move(const TrajectoryController::Goal& goal);
  void release();
  /// Where the joints are.
  [[nodiscard]] JointsState actual() const;
  /// Names as the action knows them.
  [[nodiscard]] const std::vector<std::string>& joints() const { return controller_.joints(); }
  [[nodiscard]] bool moving() const;
  [[nodiscard]] bool stopped() const;
  [[nodiscard]] double speed_scale() const;
  [[nodiscard]] Counts counts() const;

 private:
  using Action = control_msgs::FollowJointTrajectory;
  [[nodiscard]] bool accept(const Action::Goal& goal);
  void start(const UUID& id, const Action::Goal& goal);
  [[nodiscard]] bool cancel(const UUID& id);

  mutable std::mutex mutex_;  // of controller_, ends_, counts_
  TrajectoryController controller_;
  RobotFaults& faults_;
  bool of_arm_;
  std::vector<GoalEnd> ends_;  ///< of goals that others took the place of
  Counts counts_;
  std::unique_ptr<ActionServer<Action>> server_;  // last: goes before what its handlers use
};

}  // namespace canopeer::ros
