#pragma once

#include <string>
#include <vector>

#include "canopeer/cdr/messages/control_msgs.h"
#include "canopeer/robot/endless_joints.h"
#include "canopeer/robot/path_timing.h"

namespace canopeer::ros {

using FollowJointTrajectory = control_msgs::FollowJointTrajectory;

/// How a motion is said to a controller.
struct TrajectoryOptions {
  double rate_hz = 100.0;       ///< points a second, at least; at most 20000 points in all
  double path_tolerance = 0.0;  ///< rad (m); 0: the controller's own
  double goal_tolerance = 0.0;  ///< rad (m); 0: the controller's own
  double goal_time_tolerance_s = 0.0;
  JointLimits limits{};  ///< of what is made up for; empty: it takes half a second
};

/// The goal that has a controller follow `motion`: positions, velocities and accelerations. The
/// last point is the motion's end, to the bit. `joints`: the driver's names, in the order of
/// configurations. `stands`: where the joints are now, by the driver's own count. Joints that turn
/// without end run on from there; what else lies between `stands` and the motion's begin is made up
/// for in the first half second, or slower where limits want that.
[[nodiscard]] FollowJointTrajectory::Goal trajectory_goal(const PathMotion& motion,
                                                          const std::vector<std::string>& joints,
                                                          const Configuration& stands,
                                                          const EndlessJoints& endless,
                                                          const TrajectoryOptions& options);

/// How long the controller will take for it, s.
[[nodiscard]] double duration_s(const FollowJointTrajectory::Goal& goal);

/// Positions of the last point: where the motion ends by the driver's count.
[[nodiscard]] Configuration end_of(const FollowJointTrajectory::Goal& goal);

}  // namespace canopeer::ros
