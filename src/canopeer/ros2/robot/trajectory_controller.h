#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/cdr/messages/action_types.h"
#include "canopeer/cdr/messages/control_msgs.h"
#include "canopeer/dds/action.h"
#include "canopeer/ros2/robot/joint_curve.h"
#include "canopeer/ros2/robot/robot_faults.h"

namespace canopeer::ros {

/// A controller and the joints it moves; rad, or m for prismatic ones.
struct ControllerOptions {
  std::vector<std::string> joints;
  Configuration lower;  ///< no goal beyond
  Configuration upper;
  double lag_s = 0.01;           ///< joints follow their set points with this time constant
  double brake_s = 0.2;          ///< a motion that is cut short stops within
  double start_tolerance = 0.1;  ///< goals that begin farther away are refused
  double path_tolerance = 0.2;   ///< where the goal says none
  double goal_tolerance = 0.05;  ///< likewise
};

/// How a goal ended.
struct GoalEnd {
  UUID goal;
  GoalState state = GoalState::succeeded;
  std::int32_t code = 0;  ///< FollowJointTrajectory::Result
  std::string why;
};

/// Follows joint trajectories as the controllers of ros2_control do: one goal at a time, a new one
/// takes the place of the one before. Moves perfect joints behind a short lag. Not thread-safe.
class TrajectoryController {
 public:
  using Goal = control_msgs::FollowJointTrajectory::Goal;
  using Feedback = control_msgs::FollowJointTrajectory::Feedback;

  /// `faults`: what goes wrong; null: nothing. Outlives the controller.
  TrajectoryController(ControllerOptions options, const Configuration& start,
                       RobotFaults* faults = nullptr);

  /// The error: why the goal is refused.
  [[nodiscard]] Expected<void> check(const Goal& goal) const;
  /// Starts a goal that was checked; how the one before ended, if there was one.
  [[nodiscard]] std::optional<GoalEnd> begin(const UUID& id, const Goal& goal);
  /// Has the joints come to a stop on their path; the end comes from tick(). False: that goal is
  /// not under way.
  [[nodiscard]] bool cancel(const UUID& id);
  /// After a protective stop: takes goals again.
  void release() { stopped_ = false; }

  /// Time passes. How the goal under way ended, if it did.
  [[nodiscard]] std::optional<GoalEnd> tick(double dt_s);

  [[nodiscard]] const JointsState& actual() const { return actual_; }
  /// The goal under way.
  [[nodiscard]] const std::optional<UUID>& goal() const { return id_; }
  /// Without the header's stamp.
  [[nodiscard]] Feedback feedback() const;
  /// Of the trajectory's time, 0 … 1.
  [[nodiscard]] double speed_scale() const;
  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] const std::vector<std::string>& joints() const { return options_.joints; }

 private:
  struct Tolerances {
    Configuration path;
    Configuration goal;
    double goal_time_s = 0.0;  ///< 0: no limit
  };
  [[nodiscard]] Expected<JointCurve> curve_of(const Goal& goal) const;
  [[nodiscard]] Tolerances tolerances_of(const Goal& goal) const;
  void advance(double dt_s);
  [[nodiscard]] std::optional<GoalEnd> injected_end();
  [[nodiscard]] std::optional<GoalEnd> regular_end();
  [[nodiscard]] GoalEnd end(GoalState state, std::int32_t code, std::string why);
  void stand_where_it_is();
  [[nodiscard]] std::optional<std::array<double, 2>> due(RobotFault fault) const;

  ControllerOptions options_;
  RobotFaults* faults_;
  JointCurve curve_;
  double time_s_ = 0.0;  ///< along the curve
  double brake_ = 1.0;   ///< share of the speed left; falls when braking
  bool braking_ = false;
  bool canceling_ = false;
  bool stopped_ = false;    ///< protective stop
  bool held_back_ = false;  ///< by a fault
  Configuration aside_;     ///< by which a fault has it miss the goal
  JointsState desired_;
  JointsState actual_;
  std::optional<UUID> id_;
  Tolerances tolerances_;
};

}  // namespace canopeer::ros
