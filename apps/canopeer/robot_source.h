#pragma once

#include <filesystem>
#include <vector>

#include "canopeer/config/mission_file.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer::app {

/// Where ROS says packages are: ROS_PACKAGE_PATH and AMENT_PREFIX_PATH of the environment.
[[nodiscard]] std::vector<std::filesystem::path> ros_package_path();

/// The mission's robot; its notices go to standard error. Ends the command when it cannot be read.
[[nodiscard]] RobotModel robot_of(const MissionFile& file);

}  // namespace canopeer::app
