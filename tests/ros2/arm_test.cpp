#include <gtest/gtest.h>

#include "canopeer/cdr/messages/ur_dashboard_msgs.h"
#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/arm/ros2_arm.h"
#include "ros_fixture.h"
#include "support/must.h"
#include "support/planning_fixture.h"
#include "test_controller.h"

namespace canopeer::ros {
namespace {

using test::test_robot;
using testing_support::ControllerFaults;
using testing_support::eventually;
using testing_support::TestController;

constexpr const char* kAction = "/arm/follow_joint_trajectory";

Ros2Settings quick_settings() {
  Ros2Settings settings;
  settings.arm.action = kAction;
  settings.arm.first_motions = 0;
  return settings;
}

/// The shipped robot's arm, a controller for it, and our side.
class Ros2ArmTest : public ::testing::Test {
 protected:
  void start(const Ros2Settings& settings = quick_settings()) {
    controller_.emplace(*robot_node_, kAction, test_robot().setup().arm_joints, numbers(home_));
    joints_ = std::make_unique<JointHistory>(test_robot().setup().arm_joints);
    listener_ = std::make_unique<JointListener>(settings.arm.joint_names,
                                                std::vector<JointHistory*>{joints_.get()},
                                                [this] { return clock_.now(); });
    must(listener_->listen(*node_, settings.arm.joint_states));
    PersonHooks person;
    person.stop_asked = [this] { return stop_.load(); };
    person.going_home = [this] { return stop_heard_.load(); };
    person.stop_at_once = [this] { return at_once_.load(); };
    if (settings.confirm) {
      person.may_move = [this](const std::string& what) {
        asked_ = what;
        return confirmed_;
      };
    }
    arm_ = must(Ros2Arm::make({*node_, test_robot(), *joints_, clock_, person,
                               [this] { return listener_->contradiction(); }},
                              settings));
    ASSERT_TRUE(eventually([&] {
      return arm_->ready() && joints_->last().has_value() &&
             !robot_node_->subscribers_of(std::string(kAction) + "/_action/feedback").empty();
    }));
  }

  static std::vector<double> numbers(const Configuration& q) {
    return {q.data(), q.data() + q.size()};
  }
  /// A short way from home: about half a second.
  JointPath a_motion(double by = 0.2) const {
    Configuration to = home_;
    to[0] += by;
    to[2] -= by;
    return {{home_, to}};
  }
  MotionOutcome move(const JointPath& path) {
    const auto planned = arm_->start(path);
    EXPECT_TRUE(planned) << planned.error().message;
    auto outcome = arm_->finish();
    EXPECT_TRUE(outcome) << outcome.error().message;
    return outcome.value_or(MotionOutcome());
  }
  MotionOutcome move_with(const std::function<void(ControllerFaults&)>& change) {
    start();
    controller_->faults(change);
    return move(a_motion());
  }

  Configuration home_ = test_robot().home("side_1");
  std::unique_ptr<Node> robot_node_ = testing_support::make_node("robot");
  std::unique_ptr<Node> node_ = testing_support::make_node("canopeer");
  RosClock clock_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> stop_heard_{false};
  std::atomic<bool> at_once_{false};
  bool confirmed_ = true;
  std::string asked_;
  std::optional<TestController> controller_;
  std::unique_ptr<JointHistory> joints_;
  std::unique_ptr<JointListener> listener_;
  std::unique_ptr<Ros2Arm> arm_;
};

TEST_F(Ros2ArmTest, ArrivesWhereThePathEnds) {
  start();
  const JointPath path = a_motion();
  const auto planned = arm_->start(path);
  ASSERT_TRUE(planned);
  EXPECT_NEAR(*planned, PathMotion(path, test_robot().limits()).duration_s(), 1e-6);
  const auto outcome = arm_->finish();
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->end, MotionEnd::arrived) << outcome->why;
  EXPECT_LT((outcome->q - path.waypoints.back()).norm(), 1e-9);
  const auto goal = controller_->last_goal();
  EXPECT_EQ(goal.path_tolerance.size(), 6U);
  EXPECT_EQ(goal.goal_tolerance.at(0).position, 0.01);
}

TEST_F(Ros2ArmTest, MovesNoFasterThanSharpFramesAllow) {
  start();
  JointPath path = a_motion();
  const double quick_s = PathMotion(path, test_robot()).duration_s();
  path.sharp = ImageMotionLimit{CameraIntrinsics(), 0.5, 60.0};
  const auto planned = arm_->start(path);
  ASSERT_TRUE(planned);
  EXPECT_NEAR(*planned, PathMotion(path, test_robot()).duration_s(), 1e-6);
  EXPECT_GT(*planned, 1.2 * quick_s);
  EXPECT_EQ(must(arm_->finish()).end, MotionEnd::arrived);
}

TEST_F(Ros2ArmTest, RefusesWithoutFreshJointStates) {
  start();
  controller_->faults([](ControllerFaults& f) { f.joint_states = false; });
  ASSERT_TRUE(eventually([&] { return joints_->silence_s() > 0.6; }));
  const auto planned = arm_->start(a_motion());
  ASSERT_FALSE(planned);
  EXPECT_NE(planned.error().message.find("no joint state of"), std::string::npos);
  EXPECT_EQ(controller_->goals(), 0);
}

TEST_F(Ros2ArmTest, IsLostWhenTwoContradictEachOther) {
  start();
  const auto other = must(robot_node_->advertise<sensor_msgs::JointState>("/joint_states"));
  sensor_msgs::JointState state;
  state.name = {test_robot().setup().arm_joints[0]};
  state.position = {home_[0]};
  const auto said_for = [&](std::chrono::milliseconds span) {
    const auto end = JointHistory::Steady::now() + span;
    return eventually([&] {
      other.publish(state);
      return !arm_->fresh() || JointHistory::Steady::now() > end;
    });
  };
  ASSERT_TRUE(said_for(std::chrono::milliseconds(800)));
  EXPECT_TRUE(arm_->fresh()) << "they agree";
  state.position = {home_[0] + 0.1};
  ASSERT_TRUE(said_for(std::chrono::seconds(20)));
  const auto fresh = arm_->fresh();
  ASSERT_FALSE(fresh);
  EXPECT_NE(fresh.error().message.find("two publishers contradict each other: " + state.name[0]),
            std::string::npos)
      << fresh.error().message;
  EXPECT_FALSE(arm_->start(a_motion()));
}

TEST_F(Ros2ArmTest, RefusesToBeginElsewhereThanWhereTheArmIs) {
  start();
  JointPath path = a_motion();
  path.waypoints.front()[1] += 0.05;
  const MotionOutcome outcome = move(path);
  EXPECT_EQ(outcome.end, MotionEnd::refused);
  EXPECT_NE(outcome.why.find("was the arm moved?"), std::string::npos) << outcome.why;
  EXPECT_EQ(controller_->goals(), 0);
}

TEST_F(Ros2ArmTest, MakesUpForASmallDifferenceAtTheStart) {
  start();
  JointPath path = a_motion();
  path.waypoints.front()[1] += 0.01;
  EXPECT_EQ(move(path).end, MotionEnd::arrived);
  EXPECT_NEAR(controller_->last_goal().trajectory.points.front().positions[1], home_[1], 1e-9);
}

TEST_F(Ros2ArmTest, FirstMotionsTakeLonger) {
  Ros2Settings settings = quick_settings();
  settings.arm.first_motions = 1;
  settings.arm.first_motion_scale = 0.5;
  start(settings);
  const JointPath there = a_motion(0.1);
  const double quick_s = PathMotion(there, test_robot().limits()).duration_s();
  const auto first = arm_->start(there);
  ASSERT_TRUE(first);
  EXPECT_NEAR(*first, 2.0 * quick_s, 0.01 * quick_s);
  EXPECT_EQ(must(arm_->finish()).end, MotionEnd::arrived);
  const auto second = arm_->start({{there.waypoints.back(), there.waypoints.front()}});
  ASSERT_TRUE(second);
  EXPECT_NEAR(*second, quick_s, 0.01 * quick_s);
  EXPECT_EQ(must(arm_->finish()).end, MotionEnd::arrived);
}

TEST_F(Ros2ArmTest, WaitsForTheResultNotForTheTime) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) { f.speed = 0.3; });
  EXPECT_EQ(outcome.end, MotionEnd::arrived) << outcome.why;
}

TEST_F(Ros2ArmTest, ARejectedGoalIsRefused) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) { f.reject = true; });
  EXPECT_EQ(outcome.end, MotionEnd::refused);
  EXPECT_EQ(outcome.q, home_);
}

TEST_F(Ros2ArmTest, AnAbortedGoalIsAbortedAndSaysWhy) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) {
    f.end_at = 0.5;
    f.end_code = FollowJointTrajectory::Result::PATH_TOLERANCE_VIOLATED;
    f.end_text = "state tolerances failed for joint 2";
  });
  EXPECT_EQ(outcome.end, MotionEnd::aborted);
  EXPECT_NE(outcome.why.find("left its path"), std::string::npos) << outcome.why;
  EXPECT_NE(outcome.why.find("joint 2"), std::string::npos);
  EXPECT_GT(outcome.q[0], home_[0]);
  EXPECT_LT(outcome.q[0], home_[0] + 0.2);
}

TEST_F(Ros2ArmTest, SuccessElsewhereIsAborted) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) { f.miss = 0.1; });
  EXPECT_EQ(outcome.end, MotionEnd::aborted);
  EXPECT_NE(outcome.why.find("0.100 from its goal"), std::string::npos) << outcome.why;
}

TEST_F(Ros2ArmTest, SuccessWithAnErrorCodeIsAborted) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) { f.success_code = -5; });
  EXPECT_EQ(outcome.end, MotionEnd::aborted);
}

TEST_F(Ros2ArmTest, AGoalThatSomebodyElseEndsIsPreempted) {
  MotionOutcome outcome = move_with([](ControllerFaults& f) {
    f.end_at = 0.3;
    f.end_state = GoalState::canceled;
  });
  EXPECT_EQ(outcome.end, MotionEnd::preempted);
  EXPECT_EQ(controller_->cancels(), 0);
}

TEST_F(Ros2ArmTest, ANewGoalOfSomebodyElseIsPreempted) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) {
    f.end_at = 0.3;
    f.end_text = "Current goal cancelled due to new incoming action.";
  });
  EXPECT_EQ(outcome.end, MotionEnd::preempted);
}

TEST_F(Ros2ArmTest, AControllerThatIsSwitchedOffIsAStop) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) {
    f.end_at = 0.3;
    f.end_state = GoalState::canceled;
    f.end_text = "Current goal cancelled during deactivate transition.";
  });
  EXPECT_EQ(outcome.end, MotionEnd::stopped);
}

TEST_F(Ros2ArmTest, AnArmThatIsHeldIsStopped) {
  start();
  controller_->faults([](ControllerFaults& f) {
    f.freeze_at = 0.2;
    f.speed = 0.5;
    f.end_at = 0.95;
    f.end_code = -4;
  });
  const MotionOutcome outcome = move(a_motion(0.6));
  EXPECT_EQ(outcome.end, MotionEnd::stopped) << outcome.why;
  EXPECT_NE(outcome.why.find("stood still"), std::string::npos) << outcome.why;
}

TEST_F(Ros2ArmTest, ASafetyModeStopsTheMotionAndTheNext) {
  Ros2Settings settings = quick_settings();
  settings.arm.safety_mode = "/io_and_status_controller/safety_mode";
  auto safety = must(
      robot_node_->advertise<ur_dashboard_msgs::SafetyMode>(settings.arm.safety_mode, kLatchedQos));
  start(settings);
  safety.publish({ur_dashboard_msgs::SafetyMode::NORMAL});
  controller_->faults([](ControllerFaults& f) { f.speed = 0.1; });
  ASSERT_TRUE(arm_->start(a_motion()));
  safety.publish({ur_dashboard_msgs::SafetyMode::PROTECTIVE_STOP});
  const MotionOutcome outcome = must(arm_->finish());
  EXPECT_EQ(outcome.end, MotionEnd::stopped);
  EXPECT_EQ(outcome.why, "protective stop");
  EXPECT_EQ(controller_->cancels(), 1);
  EXPECT_EQ(move({{arm_->configuration(), home_}}).end, MotionEnd::stopped);
  EXPECT_EQ(controller_->goals(), 1);
}

TEST_F(Ros2ArmTest, AMotionThatTakesTooLongIsCancelled) {
  Ros2Settings settings = quick_settings();
  settings.arm.max_slowdown = 1.5;
  settings.arm.goal_time_tolerance_s = 0.0;
  start(settings);
  controller_->faults([](ControllerFaults& f) { f.speed = 0.1; });
  const MotionOutcome outcome = move(a_motion());
  EXPECT_EQ(outcome.end, MotionEnd::cancelled);
  EXPECT_NE(outcome.why.find("too long"), std::string::npos) << outcome.why;
}

TEST_F(Ros2ArmTest, APersonWhoStopsTheRunCancelsTheMotionButNotTheWayHome) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.2; });
  ASSERT_TRUE(arm_->start(a_motion()));
  stop_ = true;
  EXPECT_EQ(must(arm_->finish()).end, MotionEnd::cancelled);
  controller_->faults([](ControllerFaults& f) { f.speed = 1.0; });
  stop_heard_ = true;
  EXPECT_EQ(move({{arm_->configuration(), home_}}).end, MotionEnd::arrived);
}

TEST_F(Ros2ArmTest, AStopThatTheMissionDoesNotKnowOfYetHoldsTheNextMotionBack) {
  start();
  stop_ = true;
  EXPECT_EQ(move(a_motion()).end, MotionEnd::cancelled);
  EXPECT_EQ(controller_->goals(), 0);
  stop_heard_ = true;
  EXPECT_EQ(move(a_motion()).end, MotionEnd::arrived);
}

TEST_F(Ros2ArmTest, ASecondStopEndsTheWayHome) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.2; });
  stop_ = stop_heard_ = true;
  ASSERT_TRUE(arm_->start(a_motion()));
  at_once_ = true;
  EXPECT_EQ(must(arm_->finish()).end, MotionEnd::cancelled);
  const auto again = arm_->start({{arm_->configuration(), home_}});
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("the arm stays where it is"), std::string::npos);
  EXPECT_EQ(controller_->goals(), 1);
}

TEST_F(Ros2ArmTest, AMotionUnderWayEndsWithItsArm) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.05; });
  ASSERT_TRUE(arm_->start(a_motion()));
  arm_.reset();
  EXPECT_TRUE(eventually([&] { return controller_->cancels() == 1; }));
}

TEST_F(Ros2ArmTest, AMotionUnderWayEndsWithTheMission) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.05; });
  ASSERT_TRUE(arm_->start(a_motion()));
  arm_->end_motion();
  EXPECT_EQ(controller_->cancels(), 1);
  arm_.reset();
  EXPECT_EQ(controller_->cancels(), 1) << "once";
}

TEST_F(Ros2ArmTest, SilentJointStatesWhileMovingAreALostArm) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.05; });
  ASSERT_TRUE(arm_->start(a_motion()));
  controller_->faults([](ControllerFaults& f) { f.joint_states = false; });
  const auto outcome = arm_->finish();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("lost the arm"), std::string::npos);
  EXPECT_EQ(controller_->cancels(), 1);
}

TEST_F(Ros2ArmTest, AControllerThatVanishesIsLostThoughJointsAreHeard) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.05; });
  ASSERT_TRUE(arm_->start(a_motion()));
  ASSERT_TRUE(
      eventually([&] { return controller_->goals() == 1 && controller_->progress() > 0.02; }));
  controller_->faults([](ControllerFaults& f) {
    f.feedback = false;
    f.answers_cancel = false;
  });
  const auto outcome = arm_->finish();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("no feedback"), std::string::npos)
      << outcome.error().message;
}

TEST_F(Ros2ArmTest, AControllerThatStopsTalkingButObeysIsCancelled) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.05; });
  ASSERT_TRUE(arm_->start(a_motion()));
  ASSERT_TRUE(
      eventually([&] { return controller_->goals() == 1 && controller_->progress() > 0.02; }));
  controller_->faults([](ControllerFaults& f) { f.feedback = false; });
  EXPECT_EQ(must(arm_->finish()).end, MotionEnd::cancelled);
}

TEST_F(Ros2ArmTest, AControllerThatGaveFeedbackBeforeIsMissedFromTheStart) {
  start();
  EXPECT_EQ(move(a_motion()).end, MotionEnd::arrived);
  controller_->faults([](ControllerFaults& f) {
    f.feedback = false;
    f.speed = 0.05;
  });
  const MotionOutcome outcome = move({{arm_->configuration(), home_}});
  EXPECT_EQ(outcome.end, MotionEnd::cancelled);
  EXPECT_NE(outcome.why.find("no feedback"), std::string::npos) << outcome.why;
}

TEST_F(Ros2ArmTest, AControllerThatLeavesIsLost) {
  start();
  controller_->faults([](ControllerFaults& f) { f.speed = 0.05; });
  ASSERT_TRUE(arm_->start(a_motion()));
  ASSERT_TRUE(eventually([&] { return controller_->goals() == 1; }));
  controller_->leave();
  const auto outcome = arm_->finish();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("its server went away"), std::string::npos)
      << outcome.error().message;
}

TEST_F(Ros2ArmTest, AControllerWithoutAnyFeedbackWorks) {
  const MotionOutcome outcome = move_with([](ControllerFaults& f) {
    f.feedback = false;
    f.speed = 0.3;
  });
  EXPECT_EQ(outcome.end, MotionEnd::arrived);
}

TEST_F(Ros2ArmTest, ADryRunSendsNothing) {
  Ros2Settings settings = quick_settings();
  settings.dry_run = true;
  start(settings);
  const auto planned = arm_->start(a_motion());
  ASSERT_TRUE(planned);
  EXPECT_GT(*planned, 0.0);
  const MotionOutcome outcome = must(arm_->finish());
  EXPECT_EQ(outcome.end, MotionEnd::withheld);
  EXPECT_EQ(outcome.q, home_);
  EXPECT_EQ(controller_->goals(), 0);
}

TEST_F(Ros2ArmTest, AsksAPersonBeforeEachMotion) {
  Ros2Settings settings = quick_settings();
  settings.confirm = true;
  start(settings);
  confirmed_ = false;
  EXPECT_EQ(move(a_motion()).end, MotionEnd::cancelled);
  EXPECT_EQ(controller_->goals(), 0);
  EXPECT_NE(asked_.find("move the arm for"), std::string::npos);
  confirmed_ = true;
  EXPECT_EQ(move(a_motion()).end, MotionEnd::arrived);
}

TEST_F(Ros2ArmTest, PositionsALittleBeyondALimitAreAtIt) {
  start();
  Configuration beyond = home_;
  beyond[0] = test_robot().limits().upper[0] + 0.005;
  controller_->put(numbers(beyond));
  ASSERT_TRUE(eventually([&] { return joints_->last()->at(0) > beyond[0] - 1e-9; }));
  EXPECT_EQ(arm_->configuration()[0], test_robot().limits().upper[0]);
}

}  // namespace
}  // namespace canopeer::ros
