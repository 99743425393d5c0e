#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "canopeer/base/rng.h"
#include "canopeer/ros2/arm/motion_ending.h"
#include "canopeer/ros2/arm/trajectory_goal.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {
namespace {

using Result = FollowJointTrajectory::Result;

const std::vector<std::string> kJoints = {"pan", "lift", "roll"};

JointLimits limits(bool roll_is_endless = false) {
  JointLimits limits;
  limits.lower = Configuration::Constant(3, -3.0);
  limits.upper = Configuration::Constant(3, 3.0);
  limits.velocity = Configuration::Constant(3, 1.0);
  limits.acceleration = Configuration::Constant(3, 2.0);
  if (roll_is_endless) {
    limits.lower[2] = -std::numeric_limits<double>::infinity();
    limits.upper[2] = std::numeric_limits<double>::infinity();
  }
  return limits;
}

Configuration q(double a, double b, double c) {
  Configuration q(3);
  q << a, b, c;
  return q;
}

double time_of(const trajectory_msgs::JointTrajectoryPoint& point) {
  return seconds(stamp_of({point.time_from_start.sec, point.time_from_start.nanosec}));
}

FollowJointTrajectory::Goal goal_of(const PathMotion& motion, const Configuration& stands,
                                    const EndlessJoints& endless = {}, double rate_hz = 100.0) {
  return trajectory_goal(motion, kJoints, stands, endless, {rate_hz, 0.1, 0.01, 5.0});
}

/// Random ways of three places, their corners rounded.
JointPath random_path(Rng& rng) {
  JointPath path;
  for (int i = 0; i < 3; ++i) {
    path.waypoints.push_back(q(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)));
  }
  path.deviations = {0.0, 0.05, 0.0};
  return path;
}

TEST(TrajectoryGoal, FollowsTheMotionAtItsRateAndEndsExactlyAtItsEnd) {
  Rng rng(3, "trajectories");
  for (int i = 0; i < 50; ++i) {
    const JointPath path = random_path(rng);
    const PathMotion motion(path, limits());
    const auto goal = goal_of(motion, path.waypoints.front());
    const auto& points = goal.trajectory.points;
    EXPECT_EQ(goal.trajectory.joint_names, kJoints);
    EXPECT_EQ(goal.trajectory.header.stamp.sec, 0);  // begins when it is there
    EXPECT_EQ(end_of(goal), path.waypoints.back());
    EXPECT_NEAR(duration_s(goal), motion.duration_s(), 1e-8);
    EXPECT_EQ(time_of(points.front()), 0.0);
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double dt_s = time_of(points[k]) - time_of(points[k - 1]);
      ASSERT_GT(dt_s, 0.0);
      ASSERT_LE(dt_s, 0.0100001);
      for (std::size_t j = 0; j < 3; ++j) {
        // Velocities and accelerations are those of the positions: limits hold.
        ASSERT_LE(std::abs(points[k].positions[j] - points[k - 1].positions[j]), 1.0 * dt_s + 1e-7);
        ASSERT_LE(std::abs(points[k].velocities[j]), 1.0 + 1e-9);
        ASSERT_LE(std::abs(points[k].accelerations[j]), 2.0 + 1e-9);
        ASSERT_LE(std::abs(points[k].velocities[j] - points[k - 1].velocities[j]),
                  2.0 * dt_s + 1e-7);
      }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(points.back().velocities[j], 0.0);
      EXPECT_EQ(points.back().accelerations[j], 0.0);
    }
  }
}

TEST(TrajectoryGoal, BeginsWhereTheJointsStandAndIsOnThePathSoon) {
  const PathMotion motion(std::vector<Configuration>{q(0, 0, 0), q(1, 0, 0)}, limits());
  const auto goal = goal_of(motion, q(0.01, -0.02, 0.0));
  const auto& points = goal.trajectory.points;
  EXPECT_NEAR(points.front().positions[0], 0.01, 1e-12);
  EXPECT_NEAR(points.front().positions[1], -0.02, 1e-12);
  EXPECT_EQ(points.front().velocities[1], 0.0);
  for (std::size_t k = 1; k < points.size(); ++k) {
    EXPECT_LE(points[k].positions[1], 0.0);
    EXPECT_GE(points[k].positions[1], points[k - 1].positions[1]);  // straight back
    EXPECT_LT(std::abs(points[k].velocities[1]), 0.08);
    if (time_of(points[k]) >= 0.5) {
      EXPECT_EQ(points[k].positions[1], 0.0);
    }
  }
  EXPECT_EQ(end_of(goal), q(1, 0, 0));
}

TEST(TrajectoryGoal, MakesUpNoFasterThanLimitsAllow) {
  JointLimits slow = limits();
  slow.velocity *= 0.05;
  slow.acceleration *= 0.0025;
  const PathMotion motion(std::vector<Configuration>{q(0, 0, 0)}, slow);
  const auto goal = trajectory_goal(motion, kJoints, q(0.1, 0, 0), {}, {100.0, 0, 0, 0, slow});
  double fastest = 0.0;
  double strongest = 0.0;
  for (const auto& point : goal.trajectory.points) {
    fastest = std::max(fastest, std::abs(point.velocities[0]));
    strongest = std::max(strongest, std::abs(point.accelerations[0]));
  }
  EXPECT_LE(fastest, slow.velocity[0]);
  EXPECT_LE(strongest, slow.acceleration[0]);
  EXPECT_GT(strongest, 0.9 * slow.acceleration[0]) << "no slower than need be";
  EXPECT_EQ(end_of(goal), q(0, 0, 0));
}

TEST(TrajectoryGoal, OfNoWayStillStandsThere) {
  const PathMotion motion(std::vector<Configuration>{q(0.3, 0, 0)}, limits());
  const auto goal = goal_of(motion, q(0.3, 0, 0));
  EXPECT_GT(duration_s(goal), 0.0);
  EXPECT_EQ(end_of(goal), q(0.3, 0, 0));
  EXPECT_GE(duration_s(goal_of(motion, q(0.31, 0, 0))), 0.5);
}

TEST(TrajectoryGoal, RunsOnFromTheDriversCountOfTurns) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const EndlessJoints endless(limits(true));
  const PathMotion motion(std::vector<Configuration>{q(0, 0, 3.0), q(0, 0, 3.5)}, limits(true));
  const auto goal = goal_of(motion, q(0.0, 0.0, 3.0 - 2.0 * kTurn), endless);
  EXPECT_NEAR(goal.trajectory.points.front().positions[2], 3.0 - 2.0 * kTurn, 1e-9);
  EXPECT_NEAR(end_of(goal)[2], 3.5 - 2.0 * kTurn, 1e-9);
  for (std::size_t k = 1; k < goal.trajectory.points.size(); ++k) {
    EXPECT_LT(std::abs(goal.trajectory.points[k].positions[2] -
                       goal.trajectory.points[k - 1].positions[2]),
              0.02);
  }
}

TEST(TrajectoryGoal, HasToleranceOnlyWhereOneIsWanted) {
  const PathMotion motion(std::vector<Configuration>{q(0, 0, 0), q(1, 0, 0)}, limits());
  const auto goal = trajectory_goal(motion, kJoints, q(0, 0, 0), {}, {100.0, 0.0, 0.02, 1.5});
  EXPECT_TRUE(goal.path_tolerance.empty());
  ASSERT_EQ(goal.goal_tolerance.size(), 3U);
  EXPECT_EQ(goal.goal_tolerance[2].name, "roll");
  EXPECT_EQ(goal.goal_tolerance[2].position, 0.02);
  EXPECT_EQ(goal.goal_time_tolerance.sec, 1);
  EXPECT_EQ(goal.goal_time_tolerance.nanosec, 500'000'000U);
}

TEST(TrajectoryGoal, OfALongMotionIsBounded) {
  JointLimits slow = limits();
  slow.velocity *= 1e-4;
  const PathMotion motion(std::vector<Configuration>{q(0, 0, 0), q(1, 0, 0)}, slow);
  EXPECT_LE(goal_of(motion, q(0, 0, 0), {}, 1000.0).trajectory.points.size(), 20000U);
}

MotionReport report(GoalState state, std::int32_t code = 0, const std::string& text = {}) {
  MotionReport report;
  report.goal.state = state;
  report.goal.result = {code, text};
  report.farthest_joint = "lift";
  return report;
}

TEST(MotionEnding, OfSuccessIsWhereTheArmIs) {
  MotionReport arrived = report(GoalState::succeeded);
  arrived.off_goal = 0.012;
  EXPECT_EQ(motion_ending(arrived).end, MotionEnd::arrived);
  arrived.off_goal = 0.02;
  EXPECT_EQ(motion_ending(arrived).end, MotionEnd::aborted);
  arrived.goal_tolerance = 0.0;  // the controller's affair
  EXPECT_EQ(motion_ending(arrived).end, MotionEnd::arrived);
}

TEST(MotionEnding, TellsStopsPreemptionAndAbortsApart) {
  EXPECT_EQ(motion_ending(report(GoalState::aborted, -4)).end, MotionEnd::aborted);
  EXPECT_EQ(motion_ending(report(GoalState::aborted, 0, "Emergency stop pressed")).end,
            MotionEnd::stopped);
  EXPECT_EQ(motion_ending(report(GoalState::aborted, 0, "robot in protective stop")).end,
            MotionEnd::stopped);
  EXPECT_EQ(motion_ending(report(GoalState::canceled)).end, MotionEnd::preempted);
  EXPECT_EQ(motion_ending(report(GoalState::aborted, 0, "preempted by another client")).end,
            MotionEnd::preempted);
  EXPECT_EQ(motion_ending(report(GoalState::unknown)).end, MotionEnd::stopped);
  MotionReport ours = report(GoalState::canceled);
  ours.goal.cancelled = "the run is to stop";
  EXPECT_EQ(motion_ending(ours).end, MotionEnd::cancelled);
  EXPECT_EQ(motion_ending(ours).why, "the run is to stop");
  ours.safety_stop = "protective stop";
  EXPECT_EQ(motion_ending(ours).end, MotionEnd::stopped);
}

TEST(MotionEnding, OfAnArmHeldOnItsWayIsAStopNotOfOneNearItsGoal) {
  MotionReport held = report(GoalState::aborted, -5);
  held.stood_still_s = 2.0;
  held.off_goal = 0.02;
  EXPECT_EQ(motion_ending(held).end, MotionEnd::aborted);
  held.off_goal = 0.4;
  EXPECT_EQ(motion_ending(held).end, MotionEnd::stopped);
  EXPECT_NE(motion_ending(held).why.find("lift is 0.400"), std::string::npos);
}

TEST(MotionEnding, SaysErrorCodesInWords) {
  for (std::int32_t code = -5; code <= 0; ++code) {
    const std::string text = in_words(Result{code, "as it says"});
    EXPECT_NE(text.find(": as it says"), std::string::npos);
    EXPECT_EQ(text.find("error -"), std::string::npos) << text;
  }
  EXPECT_EQ(in_words(Result{-100, ""}), "error -100");
}

}  // namespace
}  // namespace canopeer::ros
