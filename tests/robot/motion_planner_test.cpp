#include "canopeer/robot/motion_planner.h"

#include <thread>

#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr TrolleyState kTrolley{1.0, 0.0};

struct World {
  const RobotModel& robot = shipped_robot();
  Rng random{5};
  VoxelMap map = random_leaves(random, robot, kTrolley, 60);
  DistanceField field = field_around(map, robot, kTrolley);
  CollisionChecker checker{robot, kTrolley};
  World() { checker.set_map(&field); }

  Configuration free_state() {
    while (true) {
      const Configuration q = random_configuration(random, robot);
      if (checker.state_free(q)) return q;
    }
  }
};

TEST(MotionPlanner, FindsFreePathsHomeThatDoNotDependOnWhatRanBefore) {
  World world;
  const MotionPlanner planner(world.robot);
  const Configuration& home = world.robot.home("side_1");
  int bent = 0;
  std::vector<std::pair<Configuration, std::vector<Configuration>>> plans;
  for (int trial = 0; trial < 30; ++trial) {
    Configuration start = home;
    do {
      start = home;
      for (double& joint : start) joint += world.random.uniform(-1.5, 1.5);
    } while (!world.checker.state_free(start));
    const auto path = planner.plan(start, home, world.checker, 42);
    if (!path) continue;
    EXPECT_EQ(path->front(), start);
    EXPECT_EQ(path->back(), home);
    for (std::size_t i = 1; i < path->size(); ++i)
      EXPECT_TRUE(world.checker.edge_free((*path)[i - 1], (*path)[i]));
    bent += path->size() > 2;
    plans.emplace_back(start, *path);
  }
  EXPECT_GT(plans.size(), 20U);
  EXPECT_GT(bent, 0) << "no case needed RRTConnect";

  // The same again, in the other order and in two threads at once.
  const auto again = [&] {
    for (auto it = plans.rbegin(); it != plans.rend(); ++it)
      EXPECT_EQ(planner.plan(it->first, home, world.checker, 42), it->second);
  };
  std::thread other(again);
  again();
  other.join();
}

TEST(MotionPlanner, SaysNoWhenTheGoalIsBlocked) {
  World world;
  const MotionPlanner planner(world.robot);
  Configuration goal = world.robot.home("side_1");
  goal[1] = 0.6;  // into the platform
  EXPECT_FALSE(planner.plan(world.robot.home("side_1"), goal, world.checker, 1));
}

TEST(MotionPlanner, LeavesAStartThatTheMapHasBlockedMeanwhile) {
  World world;
  const Configuration& home = world.robot.home("side_1");
  const Vec3 beside =
      world.robot.T_world_base(kTrolley) * world.robot.T_base_camera(home) * Vec3(0.0, 0.0, 0.015);
  VoxelMap map;
  map.set_occupancy_log_odds(voxel_at(beside, map.resolution_m()), 2.0);
  const DistanceField field = field_around(map, world.robot, kTrolley);
  world.checker.set_map(&field);
  ASSERT_FALSE(world.checker.state_free(home));
  Configuration goal = world.robot.home("side_2");
  const auto path = MotionPlanner(world.robot).plan(home, goal, world.checker, 1);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->front(), home);
  for (std::size_t i = 2; i < path->size(); ++i)
    EXPECT_TRUE(world.checker.edge_free((*path)[i - 1], (*path)[i]));
}

}  // namespace
}  // namespace canopeer
