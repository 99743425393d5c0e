#include "robot_source.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "canopeer/config/robot_file.h"
#include "exit_status.h"

namespace canopeer::app {

std::vector<std::filesystem::path> ros_package_path() {
  std::vector<std::filesystem::path> folders;
  for (const char* variable : {"ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
    const char* const value = std::getenv(variable);
    const std::string list = value == nullptr ? "" : value;
    for (std::size_t begin = 0; begin < list.size();) {
      const std::size_t end = std::min(list.find(':', begin), list.size());
      if (end > begin) folders.emplace_back(list.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return folders;
}

RobotModel robot_of(const MissionFile& file) {
  RobotModel robot =
      value_or_stop(load_robot(file.robot, file.T_frame_camera, ros_package_path()), kBadInput);
  for (const std::string& notice : robot.description().notices)
    std::fprintf(stderr, "canopeer: notice: %s\n", notice.c_str());
  return robot;
}

}  // namespace canopeer::app
