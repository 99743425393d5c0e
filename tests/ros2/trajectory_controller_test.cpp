// The controller of the simulated robot: how it follows, what it refuses, how goals end.

#include "canopeer/ros2/robot/trajectory_controller.h"

#include <gtest/gtest.h>

#include <cmath>

namespace canopeer::ros {
namespace {

using Goal = TrajectoryController::Goal;
using Result = control_msgs::FollowJointTrajectory::Result;

builtin_interfaces::Duration duration_of(double s) {
  return {static_cast<std::int32_t>(s), static_cast<std::uint32_t>(std::fmod(s, 1.0) * 1e9)};
}

/// Joints b and a, in that order: from (0, 0) to (0.4, -0.2) in two seconds, from rest to rest.
Goal goal_of_two_seconds() {
  Goal goal;
  goal.trajectory.joint_names = {"b", "a"};
  for (const double t : {0.0, 2.0}) {
    trajectory_msgs::JointTrajectoryPoint point;
    point.positions = {-0.1 * t, 0.2 * t};
    point.velocities = {0.0, 0.0};
    point.time_from_start = duration_of(t);
    goal.trajectory.points.push_back(point);
  }
  return goal;
}

class TrajectoryControllerTest : public testing::Test {
 protected:
  static ControllerOptions options() {
    ControllerOptions options;
    options.joints = {"a", "b"};
    options.lower = Configuration::Constant(2, -1.0);
    options.upper = Configuration::Constant(2, 1.0);
    return options;
  }
  std::optional<GoalEnd> run(double seconds) {
    for (double t = 0.0; t < seconds; t += 0.008) {
      if (auto end = controller.tick(0.008)) return end;
    }
    return {};
  }
  static UUID id(std::uint8_t number) {
    UUID id;
    id.uuid[0] = number;
    return id;
  }
  std::optional<GoalEnd> begin(std::uint8_t number, const Goal& goal) {
    const auto ok = controller.check(goal);
    EXPECT_TRUE(ok) << ok.error().message;
    return controller.begin(id(number), goal);
  }
  std::string refusal(const Goal& goal) {
    const auto ok = controller.check(goal);
    return ok ? "" : ok.error().message;
  }

  RobotFaults faults;
  TrajectoryController controller{options(), Configuration::Zero(2), &faults};
};

TEST_F(TrajectoryControllerTest, ArrivesWithJointsInAnyOrderAfterTheTrajectorysTime) {
  EXPECT_FALSE(begin(1, goal_of_two_seconds()));
  EXPECT_FALSE(run(1.0));
  // Half of a cubic from rest to rest, less the lag of 10 ms at its highest speed.
  EXPECT_NEAR(controller.actual().position[0], 0.2, 0.006);
  EXPECT_NEAR(controller.actual().velocity[0], 0.3, 0.01);
  const auto end = run(1.2);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, GoalState::succeeded);
  EXPECT_EQ(end->code, Result::SUCCESSFUL);
  EXPECT_NEAR(controller.actual().position[0], 0.4, 2e-4);
  EXPECT_NEAR(controller.actual().position[1], -0.2, 2e-4);
  EXPECT_FALSE(controller.goal());
}

TEST_F(TrajectoryControllerTest, FollowsVelocitiesBetweenPoints) {
  Goal goal = goal_of_two_seconds();
  goal.trajectory.points[0].velocities = {0.0, 0.6};
  ASSERT_TRUE(controller.check(goal));
  begin(1, goal);
  run(0.2);
  EXPECT_GT(controller.actual().velocity[0], 0.4);
}

TEST_F(TrajectoryControllerTest, GoesStraightWherePointsHavePositionsOnly) {
  Goal goal = goal_of_two_seconds();
  for (auto& point : goal.trajectory.points) point.velocities.clear();
  begin(1, goal);
  run(0.5);
  EXPECT_NEAR(controller.actual().velocity[0], 0.2, 1e-6);
}

TEST_F(TrajectoryControllerTest, RefusesWhatSuchControllersRefuse) {
  Goal goal = goal_of_two_seconds();
  goal.trajectory.joint_names = {"b", "c"};
  EXPECT_NE(refusal(goal).find("'a'"), std::string::npos);
  goal.trajectory.joint_names = {"a"};
  EXPECT_NE(refusal(goal).find("match"), std::string::npos);

  goal = goal_of_two_seconds();
  goal.trajectory.points[1].time_from_start = duration_of(0.0);
  EXPECT_NE(refusal(goal).find("increasing"), std::string::npos);

  goal = goal_of_two_seconds();
  goal.trajectory.points[0].positions = {0.5, 0.0};
  EXPECT_NE(refusal(goal).find("away"), std::string::npos);

  goal = goal_of_two_seconds();
  goal.trajectory.points[1].positions = {0.0, 2.0};
  EXPECT_NE(refusal(goal).find("limits"), std::string::npos);

  goal = goal_of_two_seconds();
  goal.trajectory.points[1].positions = {0.0, std::nan("")};
  EXPECT_NE(refusal(goal).find("number"), std::string::npos);

  goal.trajectory.points.clear();
  EXPECT_NE(refusal(goal).find("empty"), std::string::npos);
}

TEST_F(TrajectoryControllerTest, StopsSoonOnItsPathWhenCancelled) {
  begin(1, goal_of_two_seconds());
  run(1.0);
  EXPECT_FALSE(controller.cancel(id(2)));
  ASSERT_TRUE(controller.cancel(id(1)));
  const auto end = run(0.4);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, GoalState::canceled);
  EXPECT_LT(controller.actual().position[0], 0.26);
  const double a = controller.actual().position[0];
  EXPECT_NEAR(controller.actual().position[1], -a / 2, 1e-6);
  run(0.5);
  EXPECT_NEAR(controller.actual().position[0], a, 2e-4);
}

TEST_F(TrajectoryControllerTest, ANewGoalTakesThePlaceOfTheOneBefore) {
  begin(1, goal_of_two_seconds());
  run(0.4);
  const auto before = begin(2, goal_of_two_seconds());
  ASSERT_TRUE(before);
  EXPECT_EQ(before->goal, id(1));
  EXPECT_EQ(before->state, GoalState::canceled);
  const auto end = run(3.0);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->goal, id(2));
  EXPECT_EQ(end->state, GoalState::succeeded);
}

TEST_F(TrajectoryControllerTest, APendantSlowsAllOfIt) {
  ASSERT_TRUE(faults.set("slow:0.25"));
  begin(1, goal_of_two_seconds());
  EXPECT_FALSE(run(7.9));
  const auto end = run(0.4);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, GoalState::succeeded);
}

TEST_F(TrajectoryControllerTest, FaultsEndMotionsEachInItsWayAndThenAreOver) {
  struct Case {
    const char* fault;
    GoalState state;
    std::int32_t code;
  };
  for (const Case& c :
       {Case{"abort", GoalState::aborted, Result::SUCCESSFUL},
        Case{"preempt", GoalState::canceled, Result::INVALID_GOAL},
        Case{"protective_stop", GoalState::canceled, Result::INVALID_GOAL},
        Case{"path_tolerance", GoalState::aborted, Result::PATH_TOLERANCE_VIOLATED}}) {
    ASSERT_TRUE(faults.set("none"));
    controller = TrajectoryController(options(), Configuration::Zero(2), &faults);
    ASSERT_TRUE(faults.set(c.fault));
    Goal goal = goal_of_two_seconds();
    goal.path_tolerance.resize(1);
    goal.path_tolerance[0].name = "a";
    goal.path_tolerance[0].position = 0.05;
    begin(1, goal);
    const auto end = run(5.0);
    ASSERT_TRUE(end) << c.fault;
    EXPECT_EQ(end->state, c.state) << c.fault;
    EXPECT_EQ(end->code, c.code) << c.fault;
    run(1.0);
    EXPECT_LT(controller.actual().position[0], 0.3) << c.fault;
    EXPECT_LT(controller.actual().velocity.norm(), 1e-6) << c.fault;
    EXPECT_TRUE(faults.said().empty()) << c.fault;
  }
}

TEST_F(TrajectoryControllerTest, AfterAProtectiveStopItTakesNoGoalsUntilReleased) {
  ASSERT_TRUE(faults.set("protective_stop:0"));
  begin(1, goal_of_two_seconds());
  run(0.1);
  EXPECT_NE(refusal(goal_of_two_seconds()).find("protective stop"), std::string::npos);
  controller.release();
  EXPECT_EQ(refusal(goal_of_two_seconds()), "");
}

TEST_F(TrajectoryControllerTest, MayMissItsGoalAndCallThatASuccess) {
  ASSERT_TRUE(faults.set("goal_missed:0.03"));
  begin(1, goal_of_two_seconds());
  const auto end = run(3.0);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, GoalState::succeeded);
  EXPECT_NEAR(controller.actual().position[0], 0.43, 1e-3);
}

TEST_F(TrajectoryControllerTest, MayNeverSayThatItArrived) {
  ASSERT_TRUE(faults.set("no_result"));
  begin(1, goal_of_two_seconds());
  EXPECT_FALSE(run(5.0));
  EXPECT_NEAR(controller.actual().position[0], 0.4, 1e-3);
}

TEST_F(TrajectoryControllerTest, AbortsWhereTheGoalIsNotReachedInItsTime) {
  ASSERT_TRUE(faults.set("path_tolerance:0.9"));
  Goal goal = goal_of_two_seconds();
  goal.goal_time_tolerance = duration_of(0.5);
  goal.goal_tolerance.resize(1);
  goal.goal_tolerance[0].name = "a";
  goal.goal_tolerance[0].position = 0.001;
  begin(1, goal);
  const auto end = run(4.0);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, GoalState::aborted);
  EXPECT_EQ(end->code, Result::GOAL_TOLERANCE_VIOLATED);
}

}  // namespace
}  // namespace canopeer::ros
