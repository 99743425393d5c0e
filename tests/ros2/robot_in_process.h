#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "canopeer/config/mission_file.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/import/world_source.h"
#include "canopeer/ros2/ros2_robot.h"
#include "support/own_network.h"

namespace canopeer::testing_support {

/// The smoke mission, its robot and its world, made once a program.
struct SmokeWorld {
  MissionFile file;
  std::unique_ptr<RobotModel> robot;
  Scene scene;

  [[nodiscard]] static const SmokeWorld& get();
};

/// The simulated robot of the smoke mission in this process; a failure otherwise.
[[nodiscard]] std::unique_ptr<Ros2Robot> start_smoke_robot(const Ros2RobotOptions& options = {});

}  // namespace canopeer::testing_support
