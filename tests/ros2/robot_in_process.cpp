#include "robot_in_process.h"

namespace canopeer::testing_support {

const SmokeWorld& SmokeWorld::get() {
  static const SmokeWorld world = [] {
    SmokeWorld made;
    auto file = load_mission(CANOPEER_SOURCE_DIR "/missions/smoke.yaml", {},
                             {CANOPEER_SOURCE_DIR "/compute_tables"});
    made.file = std::move(file.value());
    made.file.ros2.emplace();
    made.file.ros2->domain = own_domain();
    made.robot = std::make_unique<RobotModel>(load_robot(made.file.robot).value());
    made.scene = build_world(made.file.world, made.file.mission.seed).value().scene;
    return made;
  }();
  return world;
}

std::unique_ptr<Ros2Robot> start_smoke_robot(const Ros2RobotOptions& options) {
  const SmokeWorld& world = SmokeWorld::get();
  auto robot = Ros2Robot::start(world.file, *world.robot, world.scene, options);
  if (robot) return std::move(*robot);
  ADD_FAILURE() << robot.error().message;
  return nullptr;
}

}  // namespace canopeer::testing_support
