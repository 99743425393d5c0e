#pragma once

#include <string>
#include <vector>

#include "canopeer/config/mission_file.h"
#include "canopeer/dds/ros_arguments.h"

namespace canopeer::app {

/// Takes what stands behind `--ros-args` out of the words of a command line; ends the program when
/// that is wrong.
[[nodiscard]] ros::RosArguments take_ros_arguments(int argc, char** argv);

/// What they say, for a node of that name, as settings `ros2.…` of a mission: node, namespace,
/// remapping, parameters (`-p arm.speed_scale:=0.2`) and files of parameters. Ends the program when
/// a file cannot be read.
[[nodiscard]] Overrides ros2_settings(const ros::RosArguments& arguments, const std::string& node);

/// The domain in ROS_DOMAIN_ID counts where the mission names none.
void take_ros_domain(MissionFile& file);

}  // namespace canopeer::app
