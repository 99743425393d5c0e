#pragma once

#include <optional>
#include <string>

#include "canopeer/mission/ports.h"
#include "canopeer/ros2/arm/trajectory_client.h"

namespace canopeer::ros {

/// What is known when a goal has ended.
struct MotionReport {
  GoalEnding goal;
  std::optional<std::string> safety_stop;  ///< the robot says that it is in one
  /// The arm stood still for so long, s, somewhere on its way, before the controller gave up.
  double stood_still_s = 0.0;
  /// The joint that is farthest from its goal, and by how much, rad (m).
  std::string farthest_joint;
  double off_goal = 0.0;
  double goal_tolerance = 0.01;
};

/// How the motion ended, in the mission's terms, and why in words; `q` is left empty.
///
/// - The robot is in a safety stop, or the controller's words speak of one: stopped. So it is when
///   the controller gave up while the arm stood still against its will.
/// - Succeeded, but the arm is elsewhere: aborted. Succeeded with an error code: aborted.
/// - The controller has forgotten it: stopped.
/// - We cancelled it: cancelled. Somebody else did, or took the arm: preempted.
[[nodiscard]] MotionOutcome motion_ending(const MotionReport& report);

/// What an error code of FollowJointTrajectory means, and what the controller says about it.
[[nodiscard]] std::string in_words(const FollowJointTrajectory::Result& result);

}  // namespace canopeer::ros
