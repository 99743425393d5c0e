#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/mission_file.h"
#include "canopeer/geometry/angles.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

Expected<MissionFile> mission_of(const std::string& lines) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path path =
      fs::temp_directory_path() / (std::string("canopeer_planner_") + test->name() + ".yaml");
  EXPECT_TRUE(
      write_file(path, "robot: robot.yaml\nstops_travel_m: [0]\ncompute_table: free\n" + lines));
  auto mission = load_mission(path, {}, {}, Registries::built_in());
  fs::remove(path);
  return mission;
}

TEST(PlannerSections, OfTheScansAreReadEachForItself) {
  const auto file = mission_of(
      "planner: drive_by\ncoverage: {spacing_m: 0.2}\n"
      "sweep: {spacing_m: 0.4, row_distance_m: 0.5, tilt_deg: 30, stretch_m: 2.5}\n"
      "drive_by: {poses: 3, row_distance_m: 0.7, tilt_deg: 0, overrun_m: 0.25}\n");
  ASSERT_TRUE(file) << file.error().message;
  const PlannerOptions& o = file->mission.planners;
  EXPECT_EQ(o.coverage.scan.spacing_m, 0.2);
  EXPECT_EQ(o.sweep.scan.spacing_m, 0.4);
  EXPECT_EQ(o.sweep.scan.row_distance_m, 0.5);
  EXPECT_NEAR(o.sweep.scan.tilt_rad, 30 * kDegree, 1e-12);
  EXPECT_EQ(o.sweep.stretch_m, 2.5);
  EXPECT_EQ(file->mission.planner, "drive_by");
  EXPECT_EQ(o.drive_by.poses, 3);
  EXPECT_EQ(o.drive_by.row_distance_m, 0.7);
  EXPECT_EQ(o.drive_by.tilt_rad, 0.0);
  EXPECT_EQ(o.drive_by.overrun_m, 0.25);
}

TEST(PlannerSections, ErrorsSayWhatWasExpected) {
  const auto poses = mission_of("drive_by: {poses: 4}\n");
  ASSERT_FALSE(poses);
  EXPECT_NE(poses.error().message.find("poses: expected a whole number between 1 and 3"),
            std::string::npos)
      << poses.error().message;
  const auto stretch = mission_of("sweep: {stretch_m: 0}\n");
  ASSERT_FALSE(stretch);
  EXPECT_NE(stretch.error().message.find("stretch_m"), std::string::npos);
  const auto typo = mission_of("sweep: {strech_m: 1}\n");
  ASSERT_FALSE(typo);
  EXPECT_NE(typo.error().message.find("strech_m"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
