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

TEST(PlannerSections, PathsOfPlansBeginAtTheMissionFile) {
  const auto beside = mission_of("playback: {plan: plans/best.json}\n");
  ASSERT_TRUE(beside) << beside.error().message;
  EXPECT_EQ(beside->mission.planners.playback.plan,
            fs::temp_directory_path() / "plans" / "best.json");
  const auto elsewhere = mission_of("playback: {plan: /plans/best.json}\n");
  ASSERT_TRUE(elsewhere) << elsewhere.error().message;
  EXPECT_EQ(elsewhere->mission.planners.playback.plan, "/plans/best.json");
}

TEST(PlannerSections, OfTheInspectionPlannersIsRead) {
  const auto file = mission_of(
      "planner: gomvp_t\n"
      "gomvp: {max_targets: 50, target_grid_m: 0.03, max_candidates: 200, max_views: 20, "
      "neighbors: 5, max_nodes: 0, max_iterations: 7, replan_share: 0.5, give_up_after: 3, "
      "roi_weight: 3, occupied_weight: 1.5, border_weight: 0.5, roi_share: 0.6, "
      "occupied_share: 0.4, border_share: 0}\n");
  ASSERT_TRUE(file) << file.error().message;
  const GomvpOptions& o = file->mission.planners.gomvp;
  EXPECT_EQ(o.max_targets, 50);
  EXPECT_EQ(o.target_grid_m, 0.03);
  EXPECT_EQ(o.max_candidates, 200);
  EXPECT_EQ(o.max_views, 20);
  EXPECT_EQ(o.neighbors, 5);
  EXPECT_EQ(o.max_nodes, 0);
  EXPECT_EQ(o.max_iterations, 7);
  EXPECT_EQ(o.replan_share, 0.5);
  EXPECT_EQ(o.give_up_after, 3);
  EXPECT_EQ(o.roi_weight, 3.0);
  EXPECT_EQ(o.occupied_weight, 1.5);
  EXPECT_EQ(o.border_weight, 0.5);
  EXPECT_EQ(o.shares.roi, 0.6);
  EXPECT_EQ(o.shares.border, 0.0);
  const auto shares = mission_of("gomvp: {roi_share: 0.9}\n");
  ASSERT_FALSE(shares);
  EXPECT_NE(shares.error().message.find("must sum to 1"), std::string::npos);
  EXPECT_FALSE(mission_of("gomvp: {max_views: 1001}\n"));
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
