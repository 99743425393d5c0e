#include "canopeer/robot/arm_extent.h"

#include <gtest/gtest.h>

#include <numbers>

#include "robot_fixture.h"

namespace canopeer {
namespace {

TEST(ArmExtent, HoldsEveryShapeAndNotMuchMore) {
  const RobotModel& robot = shipped_robot();
  Rng random(3);
  std::vector<Pose> T_world_link;
  for (int i = 0; i < 50; ++i) {
    const Configuration q = random_configuration(random, robot);
    const Box extent = arm_extent(robot, q);
    robot.link_poses(q, {1.5, 0.3}, T_world_link);
    const Pose T_base_world = robot.T_world_base({1.5, 0.3}).inverse();
    Box corners;
    for (const int link : robot.moving_links()) {
      for (const auto& shape : robot.links()[static_cast<std::size_t>(link)].collision) {
        for (int corner = 0; corner < 8; ++corner) {
          Vec3 p = shape.half_extents();
          for (int k = 0; k < 3; ++k) p[k] *= (corner >> k) % 2 == 0 ? 1.0 : -1.0;
          corners.extend(T_base_world * T_world_link[static_cast<std::size_t>(link)] *
                         shape.T_link_shape * p);
        }
      }
    }
    EXPECT_TRUE(extent.min().isApprox(corners.min(), 1e-9)) << extent.min() - corners.min();
    EXPECT_TRUE(extent.max().isApprox(corners.max(), 1e-9)) << extent.max() - corners.max();
  }
}

TEST(ArmExtent, AtHomeTheArmKeepsToTheAisleAndStretchedAcrossItDoesNot) {
  const RobotModel& robot = shipped_robot();
  EXPECT_TRUE(keeps_to_aisle(robot, robot.home("side_1")));
  Configuration across = Configuration::Zero(robot.dof());
  across[0] = std::numbers::pi / 2.0;
  EXPECT_FALSE(keeps_to_aisle(robot, across));
  // Along the row there is as much room as one likes.
  EXPECT_GT(arm_extent(robot, Configuration::Zero(robot.dof())).sizes().maxCoeff(), 0.8);
}

TEST(ArmExtent, WhereNoAisleIsKnownNothingKeepsToIt) {
  RobotSetup setup = shipped_robot().setup();
  setup.known_free = Box();
  const auto robot = RobotModel::make(shipped_robot().description(), setup);
  ASSERT_TRUE(robot);
  EXPECT_FALSE(keeps_to_aisle(*robot, robot->home("side_1")));
}

}  // namespace
}  // namespace canopeer
