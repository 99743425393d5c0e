#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"

namespace canopeer::app {

struct Ros2RobotArguments {
  MissionArguments mission;
  std::string node = "simulated_robot";
  std::vector<std::string> faults;
  std::optional<double> for_s;  ///< none: until it is interrupted
  double camera_rate_hz = 6.0;
  double camera_latency_s = 0.03;
  std::string color_encoding = "rgb8";
  std::string depth_encoding = "16UC1";
  double joint_rate_hz = 125.0;
  bool split_joint_states = false;
  bool sim_time = false;
  double sim_rate = 1.0;
};

struct Ros2CheckArguments {
  MissionArguments mission;
  double listen_s = 3.0;
  bool move = false;
};

/// What the commands below `ros2` are told.
struct Ros2Arguments {
  Ros2RobotArguments robot;
  Ros2CheckArguments check;
};

/// The group of commands `ros2`.
void add_ros2(CLI::App& app, Ros2Arguments& arguments, const RunRegistries& registries);

void ros2_robot(const Ros2RobotArguments& arguments);
void ros2_check(const Ros2CheckArguments& arguments);

}  // namespace canopeer::app
