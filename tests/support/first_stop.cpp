#include "support/first_stop.h"

#include "canopeer/scene/worlds.h"
#include "support/must.h"

namespace canopeer::test {
namespace {

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

FirstStop::FirstStop(const RobotModel& model)
    : robot(model),
      ik(must(ArmIk::make(robot))),
      scene(make_world(scenario_1_world(), 1)),
      perception(mission, DetectorRegistry::built_in()),
      frame(frame_at_stop_1(robot)),
      checker(robot, frame.trolley) {
  perception.move_field(frame.T_world_base.translation());
  checker.set_map(&perception.field());
}

Observation FirstStop::see(const RgbdFrame& seen) {
  WorkMeter work;
  StageTimer timer;
  return must(perception.observe(seen, frame.sampling_region_world, work, timer));
}

}  // namespace canopeer::test
