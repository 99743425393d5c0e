#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// A mission file of its own for each case, beside nothing else.
class BadInput : public ::testing::Test {
 protected:
  /// Runs a mission with these lines; expects status 2, every one of `words` in one line of
  /// message, and no output.
  void expect_refused(const std::string& yaml, const std::vector<std::string>& words,
                      std::vector<std::string> options = {}) {
    const fs::path mission = directory_ / "mission.yaml";
    ASSERT_TRUE(write_file(mission, yaml).has_value());
    const fs::path out = directory_ / "out";
    options.insert(options.begin(), {"run", mission.string(), "--out", out.string()});
    const auto result = test::canopeer(options);
    EXPECT_EQ(result.status, 2) << result.err;
    for (const auto& word : words) {
      EXPECT_NE(result.err.find(word), std::string::npos)
          << "no '" << word << "' in: " << result.err;
    }
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(out)) << "nothing may be half-written";
  }

  [[nodiscard]] static std::string good() {
    return "name: test\nrobot: " CANOPEER_SOURCE_DIR
           "/robots/ur5e_trolley/robot.yaml\ntime_per_segment_s: 2\nstops_travel_m: [1]\n";
  }

  test::TemporaryDirectory directory_;
};

TEST_F(BadInput, AnUnknownKeyIsNamedWithItsLineAndTheNearestKey) {
  expect_refused(good() + "graph:\n  neighbours: 5\n",
                 {"mission.yaml:6", "neighbours", "neighbors"});
}

TEST_F(BadInput, AWrongUnitOrTypeIsNamed) {
  expect_refused(good() + "camera:\n  fov_x_deg: 80 deg\n",
                 {"mission.yaml:6", "fov_x_deg", "degrees"});
  expect_refused(good() + "planner: [vmp]\n", {"mission.yaml:5", "planner"});
}

TEST_F(BadInput, AValueOutOfRangeIsNamed) {
  expect_refused(good() + "camera:\n  fov_x_deg: 400\n", {"mission.yaml:6", "fov_x_deg", "170"});
  expect_refused(good() + "view_sampling:\n  roi_share: 0.9\n", {"mission.yaml:6", "sum to 1"});
  expect_refused("robot: " CANOPEER_SOURCE_DIR
                 "/robots/ur5e_trolley/robot.yaml\nstops_travel_m: [77]\n",
                 {"travel", "limits"});
}

TEST_F(BadInput, AMissingFileIsNamed) {
  const auto result = test::canopeer({"run", "missions/nowhere.yaml"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("missions/nowhere.yaml"), std::string::npos);
  expect_refused("robot: no/robot.yaml\nstops_travel_m: [1]\n", {"no/robot.yaml"});
  expect_refused("stops_travel_m: [1]\n", {"mission.yaml", "robot", "missing"});
}

TEST_F(BadInput, MalformedYamlIsNamedWithItsLine) {
  expect_refused("robot: x\nstops_travel_m: [1\n", {"mission.yaml:"});
}

TEST_F(BadInput, AMalformedUrdfIsNamedWithItsLine) {
  const fs::path robot = directory_ / "robot";
  fs::copy(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley", robot);
  ASSERT_TRUE(
      write_file(robot / "ur5e_trolley.urdf", "<robot name=\"x\">\n  <link name=\"a\">\n</robot>\n")
          .has_value());
  expect_refused("robot: robot/robot.yaml\nstops_travel_m: [1]\n", {"ur5e_trolley.urdf:"});
}

TEST_F(BadInput, SettingsOfTheCommandLineAreCheckedAlike) {
  expect_refused(good(), {"--set", "resolution_mm", "resolution_m'"},
                 {"--set", "map.resolution_mm=10"});
  expect_refused(good(), {"key=value"}, {"--set", "map.resolution_m"});
  expect_refused(good(), {"--set", "time_per_segment_s", "seconds"}, {"--time-per-segment", "-5"});
  expect_refused(good(), {"vmp"}, {"--planner", "vpm"});
  expect_refused(good(), {"compute table", "nonsense"}, {"--compute-table", "nonsense"});
}

TEST_F(BadInput, UnknownCommandsAndOptionsAreUsageErrors) {
  EXPECT_EQ(test::canopeer({"fly"}).status, 2);
  EXPECT_EQ(test::canopeer({"run"}).status, 2);
  EXPECT_EQ(test::canopeer({"run", "missions/smoke.yaml", "--fast"}).status, 2);
  EXPECT_EQ(test::canopeer({"report", "no/such/run"}).status, 2);
  EXPECT_EQ(test::canopeer({"--help"}).status, 0);
}

}  // namespace
}  // namespace canopeer
