// Robots that are brought along: the check of their files, and missions with another arm.

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "canopeer/base/atomic_file.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

double figure(const std::string& summary, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(summary, match, std::regex("\"" + name + "\": (-?[0-9.e+-]+)"))) {
    ADD_FAILURE() << name << " is not in the summary";
    return 0.0;
  }
  return std::stod(match[1]);
}

TEST(RobotCheck, FindsNothingWrongWithTheShippedRobots) {
  const test::TemporaryDirectory directory;
  for (const char* name : {"ur5e_trolley", "panda_rail"}) {
    const fs::path out = directory / name;
    const auto result =
        test::canopeer({"robot", "check", "robots/" + std::string(name) + "/robot.yaml", "--views",
                        "500", "--states", "1000", "--out", out.string()});
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_NE(result.out.find("side_1 at lift 0.00 m: free"), std::string::npos) << result.out;
    for (const char* file : {"robot.png", "spheres.png", "suggested.srdf"})
      EXPECT_TRUE(fs::exists(out / file)) << file;
  }
}

TEST(RobotCheck, SaysWhatIsWrongAndWhere) {
  const test::TemporaryDirectory directory;
  for (const char* file : {"robot.yaml", "ur5e_trolley.urdf"}) {
    auto text = read_file(fs::path(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley") / file);
    ASSERT_TRUE(text);
    // No SRDF, a home state that bends the arm into its platform, a workspace out of reach.
    for (const auto& [from, to] :
         {std::pair("srdf: ur5e_trolley.srdf", ""),
          std::pair("side_1: [0.0, -0.7853981633974483", "side_1: [0.0, 0.6"),
          std::pair("x_m: [-0.95, 1.0], y_m: [-0.3, 0.49], z_m: [0.01, 1.17]",
                    "x_m: [3.0, 3.5], y_m: [-0.3, 0.49], z_m: [0.01, 1.17]")}) {
      const auto at = text->find(from);
      if (at != std::string::npos) text->replace(at, std::string(from).size(), to);
    }
    ASSERT_TRUE(write_file(directory / file, *text));
  }
  const auto result =
      test::canopeer({"robot", "check", (directory / "robot.yaml").string(), "--views", "200",
                      "--states", "500", "--out", (directory / "out").string()});
  EXPECT_EQ(result.status, 1);
  for (const char* what :
       {"home state 'side_1' at lift 0.00 m", "no srdf: pairs that a joint connects are left out",
        "side 2: no place in the workspace is 0.3-0.6 m from the sampling region"})
    EXPECT_NE(result.out.find(what), std::string::npos) << what << "\n" << result.out;
}

TEST(RobotCheck, RefusesBadInputWithStatusTwo) {
  const auto result = test::canopeer({"robot", "check", "robots/none/robot.yaml"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("robots/none/robot.yaml"), std::string::npos) << result.err;
}

TEST(SmokeMission, IsRefusedWhereUnknownSpaceBlocksAndNothingIsKnownToBeFree) {
  const test::TemporaryDirectory directory;
  for (const char* file : {"robot.yaml", "ur5e_trolley.urdf", "ur5e_trolley.srdf"}) {
    auto text = read_file(fs::path(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley") / file);
    ASSERT_TRUE(text);
    const auto at = text->find("known_free:");
    if (at != std::string::npos) text->erase(at);
    ASSERT_TRUE(write_file(directory / file, *text));
  }
  const auto result = test::canopeer(
      {"run", "missions/smoke.yaml", "--set", "collision.unknown=blocked", "--set",
       "robot=" + (directory / "robot.yaml").string(), "--out", (directory / "run").string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("needs known_free"), std::string::npos) << result.err;
}

TEST(SmokeMission, RunsWithTheSevenJointArmOnItsRail) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "run";
  const auto result = test::canopeer(
      {"run", "missions/smoke_rail.yaml", "--time-per-segment", "6", "--out", out.string()});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string summary = read_file(out / "summary.json").value_or("");
  EXPECT_GE(figure(summary, "views"), 3);
  EXPECT_GE(figure(summary, "detected"), 1);
  EXPECT_EQ(figure(summary, "collisions"), 0);
}

}  // namespace
}  // namespace canopeer
