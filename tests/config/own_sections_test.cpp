#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/mission_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using Texts = std::map<std::string, std::string>;

/// A program with a planner and a detector of its own reads its mission.
Expected<MissionFile> own_mission(const std::string& lines, const Overrides& overrides = {}) {
  Registries registries = Registries::built_in();
  EXPECT_TRUE(registries.planners.add("spiral", "", [](const PlannerOptions& o) {
    return std::make_unique<CoveragePlanner>(o.coverage);
  }));
  EXPECT_TRUE(registries.detectors.add("reddish", "", [](const DetectorOptions& o) {
    return std::make_unique<ColorDetector>(o.colour);
  }));
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path path =
      fs::temp_directory_path() / (std::string("canopeer_own_") + test->name() + ".yaml");
  EXPECT_TRUE(
      write_file(path, "robot: robot.yaml\nstops_travel_m: [0]\ncompute_table: free\n" + lines));
  auto mission = load_mission(path, overrides, {}, registries);
  fs::remove(path);
  return mission;
}

TEST(OwnSections, HoldAnyKeysWhoseValuesAreTexts) {
  const auto file = own_mission(
      "planner: spiral\nown_planner: {turns: 3, name: a snail, tight: true}\n"
      "detector: {kind: reddish}\nown_detector:\n  weights: \"red.bin\"\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mission.planner, "spiral");
  EXPECT_EQ(file->mission.planners.own,
            (Texts{{"turns", "3"}, {"name", "a snail"}, {"tight", "true"}}));
  EXPECT_EQ(file->mission.detector.kind, "reddish");
  EXPECT_EQ(file->mission.detector.own, (Texts{{"weights", "red.bin"}}));
  EXPECT_NE(file->settings_json.find(R"("own_planner.turns": "3")"), std::string::npos);
}

TEST(OwnSections, CanBeSetFromTheCommandLine) {
  const auto file = own_mission("own_planner: {turns: 3}\n", {{"own_planner.turns", "4.50"},
                                                              {"own_detector.weights", "red.bin"}});
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->mission.planners.own, (Texts{{"turns", "4.50"}}));
  EXPECT_EQ(file->mission.detector.own, (Texts{{"weights", "red.bin"}}));
}

TEST(OwnSections, ListsAreRefusedAndUnknownNamesAreToldTheRegisteredOnes) {
  const auto list = own_mission("own_planner: {turns: [1, 2]}\n");
  ASSERT_FALSE(list);
  EXPECT_NE(list.error().message.find("turns: expected text"), std::string::npos);
  const auto planner = own_mission("planner: helix\n");
  ASSERT_FALSE(planner);
  EXPECT_NE(planner.error().message.find("spiral, found 'helix'"), std::string::npos);
  const auto detector = own_mission("detector: {kind: greenish}\n");
  ASSERT_FALSE(detector);
  EXPECT_NE(detector.error().message.find("network, reddish"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
