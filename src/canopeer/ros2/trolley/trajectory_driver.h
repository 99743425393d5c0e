#pragma once

#include "canopeer/ros2/trolley/trolley_driver.h"

namespace canopeer::ros {

/// A trolley whose axes follow a FollowJointTrajectory action of their own.
[[nodiscard]] Expected<std::unique_ptr<TrolleyDriver>> make_trajectory_driver(
    const TrolleyParts& parts, const Ros2Settings& settings);

}  // namespace canopeer::ros
