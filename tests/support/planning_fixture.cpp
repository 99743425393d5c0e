#include "support/planning_fixture.h"

#include "canopeer/config/robot_file.h"
#include "support/must.h"

namespace canopeer::test {

const RobotModel& test_robot() {
  static const RobotModel kRobot =
      must(load_robot(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml"));
  return kRobot;
}

PlanningFixture::PlanningFixture(SimulationOptions options)
    : FirstStop(test_robot()),
      simulation(robot, scene, frame.home, frame.trolley, options),
      home(look()) {}

Observation PlanningFixture::look() { return see(must(simulation.ports().camera->capture())); }

}  // namespace canopeer::test
