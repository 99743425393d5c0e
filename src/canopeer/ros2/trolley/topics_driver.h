#pragma once

#include "canopeer/ros2/trolley/trolley_driver.h"

namespace canopeer::ros {

/// A trolley that is told places by std_msgs/Float64, a topic an axis.
[[nodiscard]] Expected<std::unique_ptr<TrolleyDriver>> make_topics_driver(
    const TrolleyParts& parts, const Ros2TrolleySettings& settings);

}  // namespace canopeer::ros
