#pragma once

#include "canopeer/ros2/trolley/trolley_driver.h"

namespace canopeer::ros {

/// A trolley that a person pushes: told where, and waited for until that person calls the service
/// `~/trolley_arrived` (std_srvs/Trigger). Where a topic says where it stands the person is told
/// when that is too far off; else the place is believed until the map says better; where that shows
/// nothing clear the person is asked once more.
[[nodiscard]] Expected<std::unique_ptr<TrolleyDriver>> make_manual_driver(
    const TrolleyParts& parts, const Ros2TrolleySettings& settings);

}  // namespace canopeer::ros
