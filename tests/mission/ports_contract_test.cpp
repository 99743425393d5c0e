#include <gtest/gtest.h>

#include "support/planning_fixture.h"

// What every implementation of the ports must do; here the simulated one.

namespace canopeer {
namespace {

TEST(PortsContract, AMotionTakesItsTimeAndEndsWhereItSaid) {
  test::PlanningFixture world;
  const Ports ports = world.simulation.ports();
  Configuration goal = world.frame.home;
  goal[0] += 0.25;
  const double begin_s = ports.clock->now_s();
  const auto duration = ports.arm->start({{world.frame.home, goal}});
  ASSERT_TRUE(duration.has_value());
  EXPECT_NEAR(*duration, 1.0, 1e-9);  // 0.25 rad under 1 rad/s²: 2·√(0.25)
  const auto outcome = ports.arm->finish();
  ASSERT_TRUE(outcome.has_value());
  EXPECT_EQ(outcome->q, goal);
  EXPECT_EQ(ports.arm->configuration(), goal);
  EXPECT_NEAR(ports.clock->now_s() - begin_s, *duration, 1e-12);
  EXPECT_FALSE(outcome->collision);
}

TEST(PortsContract, ItPassesARoundedCornerWithoutStopping) {
  test::PlanningFixture world;
  Arm& arm = *world.simulation.ports().arm;
  Configuration corner = world.frame.home;
  corner[0] += 0.4;
  Configuration goal = corner;
  goal[5] += 0.4;
  const std::vector<Configuration> waypoints = {world.frame.home, corner, goal};
  const auto rounded = arm.start({waypoints, {0.0, 0.1, 0.0}});
  const auto stopping = arm.start({waypoints});
  ASSERT_TRUE(rounded.has_value() && stopping.has_value());
  EXPECT_LT(*rounded, 0.95 * *stopping);
  EXPECT_EQ(arm.finish()->q, goal);
}

TEST(PortsContract, TimeThatIsPaidDuringAMotionIsNotPaidTwice) {
  test::PlanningFixture world;
  const Ports ports = world.simulation.ports();
  Configuration goal = world.frame.home;
  goal[0] += 0.25;
  const double begin_s = ports.clock->now_s();
  ASSERT_TRUE(ports.arm->start({{world.frame.home, goal}}).has_value());
  ports.clock->charge(0.4);
  ASSERT_TRUE(ports.arm->finish().has_value());
  EXPECT_NEAR(ports.clock->now_s() - begin_s, 1.0, 1e-9);
}

TEST(PortsContract, AMotionThatDoesNotBeginAtTheArmOrLeavesTheLimitsIsRefused) {
  test::PlanningFixture world;
  Arm& arm = *world.simulation.ports().arm;
  Configuration elsewhere = world.frame.home;
  elsewhere[1] += 0.1;
  EXPECT_FALSE(arm.start({{elsewhere, world.frame.home}}).has_value());
  elsewhere[2] = 100.0;
  EXPECT_FALSE(arm.start({{world.frame.home, elsewhere}}).has_value());
  EXPECT_FALSE(arm.start({}).has_value());
}

TEST(PortsContract, ACollisionIsNoticed) {
  test::PlanningFixture world;
  world.simulation.watch_map(&world.perception.map());
  Arm& arm = *world.simulation.ports().arm;
  Configuration folded = world.frame.home;
  folded[1] = 0.6;  // the upper arm goes down through the lift platform
  ASSERT_TRUE(arm.start({{world.frame.home, folded}}).has_value());
  EXPECT_TRUE(arm.finish()->collision);
}

TEST(PortsContract, TheTrolleyStaysOnItsRails) {
  test::PlanningFixture world;
  Trolley& trolley = *world.simulation.ports().trolley;
  EXPECT_FALSE(trolley.move_to({50.0, 0.0}).has_value());
  const double begin_s = world.simulation.ports().clock->now_s();
  ASSERT_TRUE(trolley.move_to({2.0, 0.0}).has_value());
  EXPECT_EQ(trolley.state().travel_m, 2.0);
  EXPECT_GT(world.simulation.ports().clock->now_s() - begin_s, 1.0);  // ≤ 1 m/s
}

TEST(PortsContract, AFrameCarriesItsPoseAndTime) {
  test::PlanningFixture world;
  const Ports ports = world.simulation.ports();
  ports.clock->sleep(2.5);
  const auto frame = ports.camera->capture();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->time_s, ports.clock->now_s());
  EXPECT_EQ(frame->depth.width(), frame->intrinsics.width);
  EXPECT_EQ(frame->color.height(), frame->intrinsics.height);
  EXPECT_TRUE(frame->T_world_camera.isApprox(world.frame.T_world_base *
                                             world.robot.T_base_camera(world.frame.home)));
}

}  // namespace
}  // namespace canopeer
