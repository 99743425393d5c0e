#include "support/planning_fixture.h"

#include <cstdio>
#include <cstdlib>

#include "canopeer/config/robot_file.h"
#include "canopeer/scene/worlds.h"

namespace canopeer::test {
namespace {

template <typename T>
T must(Expected<T> value) {
  if (value) return std::move(*value);
  std::fprintf(stderr, "%s\n", value.error().message.c_str());
  std::abort();
}

SegmentFrame frame_at_stop_1(const RobotModel& robot) {
  SegmentFrame frame;
  frame.trolley.travel_m = 1.0;
  frame.T_world_base = robot.T_world_base(frame.trolley);
  frame.workspace_base = robot.workspace(1);
  frame.sampling_region_world = transformed(robot.sampling_region(1), frame.T_world_base);
  frame.home = robot.home("side_1");
  return frame;
}

}  // namespace

const RobotModel& test_robot() {
  static const RobotModel kRobot =
      must(load_robot(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml"));
  return kRobot;
}

PlanningFixture::PlanningFixture(SimulationOptions options)
    : robot(test_robot()),
      ik(must(ArmIk::make(robot))),
      scene(make_world(scenario_1_world(), 1)),
      simulation(robot, scene, robot.home("side_1"), TrolleyState{1.0, 0.0}, options),
      perception(mission),
      frame(frame_at_stop_1(robot)),
      checker(robot, frame.trolley) {
  perception.move_field(frame.T_world_base.translation());
  checker.set_map(&perception.field());
  WorkMeter work;
  StageTimer timer;
  home = must(perception.observe(must(simulation.ports().camera->capture()),
                                 frame.sampling_region_world, work, timer));
}

}  // namespace canopeer::test
