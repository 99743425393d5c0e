#pragma once

#include <vector>

#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer::ros {

/// How far a camera goes to look about.
struct LookAroundOptions {
  double turn_rad = 0.22;  ///< about its own x and y
  double roll_rad = 0.4;   ///< about its axis
  double step_m = 0.05;    ///< sideways
  double max_joint = 0.9;  ///< that a joint moves away from where it was, rad (m)
};

/// Configurations near `q` from which the camera sees much the same at other angles and from other
/// places, each reached from `q` by a straight motion that is free; as far as joints and checker
/// allow.
[[nodiscard]] std::vector<Configuration> looks_around(const RobotModel& robot,
                                                      const CollisionChecker& checker,
                                                      const Configuration& q,
                                                      const LookAroundOptions& options = {});

}  // namespace canopeer::ros
