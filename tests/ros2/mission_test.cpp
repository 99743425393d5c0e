// A mission in one process, the simulated robot in another, ROS 2 between them.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <regex>
#include <thread>

#include "app/program.h"
#include "canopeer/base/atomic_file.h"
#include "child_program.h"
#include "support/own_network.h"

namespace canopeer {
namespace {

using test::TemporaryDirectory;
using testing_support::ChildProgram;
using testing_support::own_domain;

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::string> robot_words(int domain, const std::vector<std::string>& more = {}) {
  return with({"ros2", "robot", "missions/smoke.yaml", "--camera-rate", "8", "--set",
               "ros2.domain=" + std::to_string(domain)},
              more);
}

std::vector<std::string> mission_words(int domain, const std::filesystem::path& out,
                                       const std::vector<std::string>& more = {}) {
  return with({"run", "missions/smoke.yaml", "--site", "ros2", "--out", out.string(), "--set",
               "ros2.domain=" + std::to_string(domain), "--set", "ros2.discovery_s=60", "--set",
               "ros2.arm.max_silence_s=5", "--set", "ros2.arm.first_motions=0", "--set",
               "ros2.arm.speed_scale=1"},
              more);
}

double summary_figure(const std::filesystem::path& out, const std::string& name) {
  const std::string summary = read_file(out / "summary.json").value_or("");
  std::smatch match;
  if (std::regex_search(summary, match, std::regex("\"" + name + "\": (-?[0-9.e+-]+)"))) {
    return std::stod(match[1]);
  }
  ADD_FAILURE() << name << " is not in " << summary;
  return 0.0;
}

/// "3" of "goals   3: …" in the robot's report.
int report_figure(const std::string& report, const std::string& pattern) {
  std::smatch match;
  if (std::regex_search(report, match, std::regex(pattern))) return std::stoi(match[1]);
  ADD_FAILURE() << pattern << " is not in " << report;
  return -1;
}

bool eventually(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// The mission has recorded that the arm moved.
bool has_moved(const std::filesystem::path& out) {
  return read_file(out / "record").value_or("").find("\"motion\"") != std::string::npos;
}

TEST(MissionOverRos2, FindsFruitsAndTouchesNothing) {
  const TemporaryDirectory directory;
  ChildProgram mission(mission_words(own_domain(), directory / "run", {"--time-per-segment", "8"}));
  ChildProgram robot(robot_words(own_domain()));
  EXPECT_EQ(mission.wait(), 0) << mission.err();
  EXPECT_GE(summary_figure(directory / "run", "fruits_reported"), 3);
  EXPECT_GE(summary_figure(directory / "run", "views"), 3);
  EXPECT_TRUE(std::filesystem::exists(directory / "run/report.html"));
  robot.send(SIGINT);
  EXPECT_EQ(robot.wait(), 0) << robot.err();
  EXPECT_GE(report_figure(robot.out(), "goals +(\\d+)"), 3) << robot.out();
  EXPECT_EQ(report_figure(robot.out(), "(\\d+) with collisions"), 0) << robot.out();
}

TEST(MissionOverRos2, EndsWithItsResultsWhenTheRobotIsKilled) {
  const TemporaryDirectory directory;
  ChildProgram robot(robot_words(own_domain()));
  ChildProgram mission(
      mission_words(own_domain(), directory / "run",
                    {"--time-per-segment", "300", "--set", "ros2.arm.max_silence_s=2"}));
  ASSERT_TRUE(eventually([&] { return has_moved(directory / "run") || !mission.runs(); }));
  robot.send(SIGKILL);
  EXPECT_EQ(mission.wait(), 1) << mission.err();
  EXPECT_NE(mission.err().find("lost"), std::string::npos) << mission.err();
  EXPECT_GE(summary_figure(directory / "run", "views"), 1);
  EXPECT_TRUE(std::filesystem::exists(directory / "run/report.html"));

  // A robot that is started anew takes the next mission.
  ChildProgram again(robot_words(own_domain()));
  ChildProgram next(mission_words(own_domain(), directory / "next", {"--time-per-segment", "1"}));
  EXPECT_EQ(next.wait(), 0) << next.err();
  again.send(SIGINT);
  again.wait();
  EXPECT_GE(report_figure(again.out(), "goals +(\\d+)"), 1) << again.out();
}

TEST(MissionOverRos2, GoesOnAfterMotionsThatDidNotArrive) {
  const TemporaryDirectory directory;
  ChildProgram robot(robot_words(own_domain(), {"--fault", "abort:0.5@2", "--fault", "reject@4"}));
  ChildProgram mission(mission_words(own_domain(), directory / "run", {"--time-per-segment", "7"}));
  EXPECT_EQ(mission.wait(), 0) << mission.err();
  robot.send(SIGINT);
  robot.wait();
  EXPECT_EQ(report_figure(robot.out(), "(\\d+) refused"), 1) << robot.out();
  EXPECT_EQ(report_figure(robot.out(), "(\\d+) cut short"), 1) << robot.out();
  EXPECT_EQ(report_figure(robot.out(), "(\\d+) with collisions"), 0) << robot.out();
}

TEST(MissionOverRos2, DrivesTheTrolleyFromStopToStop) {
  const TemporaryDirectory directory;
  const std::vector<std::string> trolley = {
      "--set", "stops_travel_m=[1, 1.3]",
      "--set", "ros2.trolley.kind=trajectory",
      "--set", "ros2.trolley.action=/trolley_controller/follow_joint_trajectory"};
  ChildProgram robot(robot_words(own_domain(), trolley));
  ChildProgram mission(
      mission_words(own_domain(), directory / "run", with(trolley, {"--time-per-segment", "1"})));
  EXPECT_EQ(mission.wait(), 0) << mission.err();
  robot.send(SIGINT);
  robot.wait();
  const std::string record = read_file(directory / "run/record").value_or("");
  EXPECT_NE(record.find("\"kind\":\"trolley\""), std::string::npos);
  EXPECT_NE(record.find("stop 2"), std::string::npos);
  EXPECT_EQ(report_figure(robot.out(), "(\\d+) with collisions"), 0) << robot.out();
}

TEST(MissionOverRos2, MovesTheRobotOfItsOwnDomainOnly) {
  const TemporaryDirectory directory;
  ChildProgram other(robot_words(own_domain() + 100));
  ChildProgram robot(robot_words(own_domain()));
  ASSERT_TRUE(eventually([&] { return other.out().find("domain") != std::string::npos; }));
  ChildProgram mission(mission_words(own_domain(), directory / "run", {"--time-per-segment", "2"}));
  EXPECT_EQ(mission.wait(), 0) << mission.err();
  for (ChildProgram* each : {&robot, &other}) {
    each->send(SIGINT);
    EXPECT_EQ(each->wait(), 0);
  }
  EXPECT_GE(report_figure(robot.out(), "goals +(\\d+)"), 1);
  EXPECT_EQ(report_figure(other.out(), "goals +(\\d+)"), 0);
  EXPECT_EQ(report_figure(other.out(), "frames +(\\d+)"), 0);
}

}  // namespace
}  // namespace canopeer
