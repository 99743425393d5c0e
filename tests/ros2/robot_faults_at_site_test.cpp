// Every fault of the simulated robot, and what the site `ros2` makes of it.

#include <gtest/gtest.h>

#include <chrono>
#include <functional>

#include "canopeer/ros2/ros2_site.h"
#include "robot_in_process.h"

namespace canopeer {
namespace {

using testing_support::SmokeWorld;
using testing_support::start_smoke_robot;

class RobotFaultsAtSite : public testing::Test {
 protected:
  void SetUp() override {
    file_ = SmokeWorld::get().file;
    file_.ros2->arm.first_motions = 0;
    file_.ros2->camera.timeout_s = 1.5;
    file_.ros2->output.enabled = false;
    file_.ros2->discovery_s = 60.0;
    robot_ = start_smoke_robot();
    auto site = make_ros2_site({file_, *SmokeWorld::get().robot});
    ASSERT_TRUE(site) << site.error().message;
    site_ = std::move(*site);
    ports_ = site_->ports();
  }

  void switch_on(const std::string& fault) {
    const auto ok = robot_->set_fault(fault);
    ASSERT_TRUE(ok) << ok.error().message;
  }
  /// A motion of the first joint, to and fro; the error of the port as text in `error_`.
  std::optional<MotionOutcome> move() {
    error_.clear();
    const Configuration here = ports_.arm->configuration();
    Configuration there = here;
    there[0] += here[0] > 0.1 ? -0.2 : 0.2;
    auto started = ports_.arm->start({{here, there}, {}});
    if (!started) return failed(started.error());
    auto outcome = ports_.arm->finish();
    if (!outcome) return failed(outcome.error());
    return std::move(*outcome);
  }
  std::nullopt_t failed(const Error& error) {
    error_ = error.message;
    return std::nullopt;
  }
  /// How the next motion ends with that fault; "error: …" where the port says one.
  std::string end_with(const std::string& fault) {
    switch_on(fault);
    const auto outcome = move();
    return outcome ? std::string(motion_end_name(outcome->end)) : "error: " + error_;
  }

  static bool becomes(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!holds()) {
      if (std::chrono::steady_clock::now() > end) return false;
    }
    return true;
  }

  MissionFile file_;
  std::unique_ptr<Ros2Robot> robot_;
  std::unique_ptr<Site> site_;
  Ports ports_;
  std::string error_;
};

TEST_F(RobotFaultsAtSite, OfMotionsAreOutcomesToldApart) {
  EXPECT_EQ(end_with("none"), "arrived");
  EXPECT_EQ(end_with("reject"), "refused");
  EXPECT_EQ(end_with("abort"), "aborted");
  EXPECT_EQ(end_with("preempt"), "preempted");
  EXPECT_EQ(end_with("path_tolerance"), "aborted");
  EXPECT_EQ(end_with("goal_missed:0.05"), "aborted");
  EXPECT_EQ(end_with("slow:0.5"), "arrived");
  // All were of one motion each, and the pendant lets go.
  EXPECT_EQ(end_with("none"), "arrived");
  EXPECT_EQ(end_with("protective_stop"), "stopped");
  EXPECT_EQ(end_with("none"), "refused") << "until somebody looks";
  const Ros2RobotReport report = robot_->report();
  EXPECT_EQ(report.collisions, 0);
  EXPECT_EQ(report.refused, 2);
}

TEST_F(RobotFaultsAtSite, AResultThatNeverComesIsNotWaitedForForever) {
  const std::string end = end_with("no_result");
  EXPECT_NE(end, "arrived");
  EXPECT_NE(end, "");
  EXPECT_EQ(end_with("none"), "arrived");
}

TEST_F(RobotFaultsAtSite, JointStatesThatCannotBeTrustedEndTheRun) {
  for (const char* fault : {"joint_states_silent", "wrong_names", "nan_positions"}) {
    switch_on("none");
    ASSERT_TRUE(becomes([&] { return move().has_value(); })) << error_;
    switch_on(fault);
    // Old ones are known for half a second more.
    ASSERT_TRUE(becomes([&] { return !move(); })) << fault;
    EXPECT_NE(error_.find("joint"), std::string::npos) << fault << ": " << error_;
  }
}

TEST_F(RobotFaultsAtSite, ARobotThatVanishesOnItsWayIsAnError) {
  const Configuration here = ports_.arm->configuration();
  Configuration there = here;
  there[0] += 1.0;
  ASSERT_TRUE(ports_.arm->start({{here, there}, {}}));
  switch_on("vanish");
  const auto outcome = ports_.arm->finish();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("lost"), std::string::npos) << outcome.error().message;
}

TEST_F(RobotFaultsAtSite, NonsenseOnTheWireChangesNothing) {
  EXPECT_EQ(end_with("malformed"), "arrived");
  const auto frame = ports_.camera->capture();
  EXPECT_TRUE(frame) << frame.error().message;
}

TEST_F(RobotFaultsAtSite, ACameraThatIsSilentIsAnError) {
  ASSERT_TRUE(ports_.camera->capture());
  switch_on("camera_silent");
  std::string error;
  for (int i = 0; i < 20 && error.empty(); ++i) {
    ASSERT_TRUE(move());  // frames from before it are not taken
    const auto frame = ports_.camera->capture();
    if (!frame) error = frame.error().message;
  }
  EXPECT_NE(error.find("camera"), std::string::npos) << error;
}

TEST_F(RobotFaultsAtSite, DelayedFramesAreWaitedForAndShowWhereTheArmStands) {
  switch_on("frames_delayed:0.8");
  ASSERT_TRUE(move());
  const auto frame = ports_.camera->capture();
  ASSERT_TRUE(frame) << frame.error().message;
  const RobotModel& robot = *SmokeWorld::get().robot;
  const Pose there = robot.T_world_base(ports_.trolley->state()) *
                     robot.T_base_camera(ports_.arm->configuration());
  EXPECT_LT((frame->T_world_camera.translation() - there.translation()).norm(), 1e-3);
}

}  // namespace
}  // namespace canopeer
