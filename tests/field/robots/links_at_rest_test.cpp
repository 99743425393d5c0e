// What never moves, and what cannot be checked: said once, and no collision of a motion.

#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/run/stage.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::has;
using test::notices_of;

TriangleMesh floor_at(double z) {
  return make_box(Box(Vec3(-2.0, -2.0, z - 0.1), Vec3(2.0, 2.0, z)));
}

TEST(ABaseOnTheFloor, IsNoCollisionOfAMotion) {
  const RobotModel robot = test::robot_of("base_on_floor/robot.yaml");
  const ExactChecker exact(robot, {floor_at(0.001)});
  EXPECT_EQ(exact.resting_contacts({}), std::vector<std::string>{"base"});
  EXPECT_FALSE(exact.check(robot.home("side_1"), {}).any());
  Configuration down = robot.home("side_1");
  down[1] = 1.57;  // the arm itself into the floor
  down[2] = 0.6;
  down[4] = 0.0;
  const ContactReport report = exact.check(down, {});
  EXPECT_TRUE(report.structure);
  EXPECT_TRUE(has(report.pair, " / structure")) << report.pair;
  EXPECT_TRUE(ExactChecker(robot, {floor_at(-0.5)}).resting_contacts({}).empty());
}

/// What is said while a stage is made of an input's mission.
std::vector<std::string> said_by(const std::string& mission, const std::string& robot) {
  std::vector<std::string> said;
  StageRequest request;
  request.mission = test::input(mission);
  if (!robot.empty()) request.overrides = {{"robot", test::input(robot).string()}};
  request.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  request.callbacks.on_notice = [&](const std::string& text) { said.push_back(text); };
  const auto stage = Stage::make(request, RunRegistries::built_in());
  EXPECT_TRUE(stage.has_value()) << stage.error().message;
  return said;
}

TEST(ABaseOnTheFloor, IsSaidOnceWhenAMissionIsLoaded) {
  const auto said = said_by("base_on_floor/mission.yaml", "");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(has(said[0], "before the arm moves: base; that is counted as no collision"))
      << said[0];
}

TEST(ARobotWithoutShapes, IsSaidToBeUncheckedWhenItIsLoadedAndRun) {
  const std::string notice = notices_of(test::robot_of("no_shapes/robot.yaml"));
  EXPECT_TRUE(has(notice,
                  "no link that moves with the arm has a collision shape: nothing is "
                  "checked"))
      << notice;
  EXPECT_TRUE(has(notice, "'collision: visual'")) << notice;
  const auto said = said_by("base_on_floor/mission.yaml", "no_shapes/robot.yaml");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0] + "\n", notice);
}

TEST(ARobotWithoutShapes, TakesItsVisualOnesWhenAskedTo) {
  const RobotModel robot = test::robot_of("no_shapes/visual.yaml");
  EXPECT_EQ(notices_of(robot), "");
  EXPECT_GT(CollisionChecker(robot, {}).sphere_count(), 0);
  const auto& link = robot.links()[static_cast<std::size_t>(robot.link_index("link2"))];
  ASSERT_EQ(link.collision.size(), 1U);
  EXPECT_EQ(link.collision[0].kind, ShapeKind::kCylinder);
}

TEST(LinksThatCanOnlyBeSeen, AreNamed) {
  RobotModel robot = test::robot_of("base_on_floor/robot.yaml");
  EXPECT_EQ(notices_of(robot), "");
  const test::OwnFolder folder;
  std::string urdf = *read_file(test::input("base_on_floor/robot.urdf"));
  const std::string camera = "<link name=\"camera\"/>";
  folder.put("robot.urdf",
             urdf.replace(urdf.find(camera), camera.size(),
                          "<link name=\"camera\"><visual><geometry><box size=\"0.1 0.1 0.1\"/>"
                          "</geometry></visual></link>"));
  folder.put("robot.yaml", *read_file(test::input("base_on_floor/robot.yaml")));
  const auto changed = load_robot(folder.path() / "robot.yaml");
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_TRUE(
      has(notices_of(*changed), "no collision shape, so never checked for contact: camera;"))
      << notices_of(*changed);
}

}  // namespace
}  // namespace canopeer
