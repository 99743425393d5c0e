// The whole check against the simulated robot in this process.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "canopeer/ros2/ros2_check.h"
#include "robot_in_process.h"

namespace canopeer {
namespace {

using testing_support::SmokeWorld;
using testing_support::start_smoke_robot;

std::string said(const std::vector<Ros2Finding>& findings) {
  constexpr const char* kVerdicts[] = {"ok ", "notice ", "wrong "};
  std::string text;
  for (const Ros2Finding& f : findings) {
    text += kVerdicts[static_cast<int>(f.verdict)] + f.what + ": " + f.text + "\n";
  }
  return text;
}

[[nodiscard]] bool any_wrong(const std::vector<Ros2Finding>& findings) {
  for (const Ros2Finding& f : findings) {
    if (f.verdict == Ros2Finding::Verdict::wrong) return true;
  }
  return false;
}

std::vector<Ros2Finding> checked(const MissionFile& file, bool move = false) {
  Ros2CheckOptions options;
  options.listen_s = 1.0;
  options.move = move;
  options.looks = 5;
  auto findings = check_ros2_robot(file, *SmokeWorld::get().robot, options);
  if (findings) return *findings;
  ADD_FAILURE() << findings.error().message;
  return {};
}

TEST(Ros2CheckOfARobot, NothingIsWrongWithTheSimulatedOne) {
  const auto robot = start_smoke_robot();
  ASSERT_TRUE(robot);
  const auto findings = checked(SmokeWorld::get().file);
  EXPECT_FALSE(any_wrong(findings)) << said(findings);
  for (const char* what :
       {"ok peer", " joint states: /joint_states", "ok joint names", "ok arm", "ok depth",
        "ok color", "ok info", "ok frame", "tf: 'camera_optical_frame' in"}) {
    EXPECT_NE(said(findings).find(what), std::string::npos) << what << "\n" << said(findings);
  }
}

TEST(Ros2CheckOfARobot, WithoutOneItSaysWhatIsMissing) {
  MissionFile file = SmokeWorld::get().file;
  file.ros2->discovery_s = 0.5;
  file.ros2->camera.timeout_s = 0.2;
  const auto findings = checked(file);
  for (const char* what : {"wrong peers", "wrong joint states", "wrong arm", "wrong depth",
                           "wrong color", "wrong frame"}) {
    EXPECT_NE(said(findings).find(what), std::string::npos) << what << "\n" << said(findings);
  }
}

/// The number behind some words, where they are said last.
double number_behind(const std::string& text, const std::string& words) {
  const auto at = text.rfind(words);
  return at == std::string::npos ? NAN : std::stod(text.substr(at + words.size()));
}

TEST(Ros2CheckOfARobot, MovesALittleAndSaysHowFarMountingAndClockAreOff) {
  Ros2RobotOptions options;
  options.faults = {"hand_eye:20,2", "time_offset:0.06"};
  const auto robot = start_smoke_robot(options);
  ASSERT_TRUE(robot);
  MissionFile file = SmokeWorld::get().file;
  file.ros2->arm.first_motions = 0;
  file.ros2->camera.timeout_s = 30.0;
  const std::string text = said(checked(file, true));
  EXPECT_NE(text.find("wrong hand-eye"), std::string::npos) << text;
  EXPECT_NEAR(number_behind(text, "the camera sits "), 20.0, 3.0) << text;
  EXPECT_NEAR(number_behind(text.substr(text.find("the camera sits")), ") and "), 2.0, 0.3) << text;
  EXPECT_NE(text.find("wrong time offset"), std::string::npos) << text;
  EXPECT_NEAR(number_behind(text, "set ros2.camera.time_offset_s to "), -0.06, 0.006) << text;
  EXPECT_EQ(robot->report().collisions, 0);
}

}  // namespace
}  // namespace canopeer
