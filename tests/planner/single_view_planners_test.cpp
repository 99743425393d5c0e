#include <gtest/gtest.h>

#include <set>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/planner/coverage/coverage_planner.h"
#include "planner_fixture.h"

namespace canopeer {
namespace {

/// What every planner promises of a motion, on its way of ten views.
class EveryPlanner : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryPlanner, LeadsFromWhereTheArmIsAlongFreeMotionsToViewsOfTheWorkspace) {
  test::PlannerFixture run(GetParam(), test::options_for_all());
  const Box& workspace = run.world.frame.workspace_base;
  const Box grown(workspace.min() - Vec3::Constant(1e-6), workspace.max() + Vec3::Constant(1e-6));
  for (int i = 0; i < 10; ++i) {
    const Configuration before = run.q;
    ASSERT_TRUE(run.take_view()) << "view " << i;
    const auto& way = run.last.motion.waypoints;
    ASSERT_GE(way.size(), 2U);
    EXPECT_LT(joint_distance(way.front(), before), 1e-9);
    EXPECT_TRUE(grown.contains(run.world.robot.T_base_camera(way.back()).translation()));
    EXPECT_TRUE((run.world.frame.T_world_base * run.world.robot.T_base_camera(way.back()))
                    .isApprox(run.last.motion.T_world_camera, 1e-6));
  }
  // Who plays a plan back has nothing to reckon.
  if (GetParam() != "playback") {
    EXPECT_GT(run.work.seconds(run.costs), 0.0);
  }
}

TEST_P(EveryPlanner, GivesTheSameViewsForTheSameSeed) {
  test::PlannerFixture a(GetParam(), test::options_for_all());
  test::PlannerFixture b(GetParam(), test::options_for_all());
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(a.take_view(), b.take_view());
    ASSERT_EQ(a.q, b.q);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryPlanner,
                         ::testing::ValuesIn(PlannerRegistry::built_in().names()),
                         [](const auto& one) { return one.param; });

TEST(RvpPlanner, GainOfARayIsTheWeightedShareOfItsUnknownVoxels) {
  PlannerOptions options;
  auto made = std::make_unique<RvpPlanner>(options.rvp);
  RvpPlanner& rvp = *made;
  test::PlannerFixture run(std::move(made));
  const VoxelMap& map = run.world.perception.map();
  Rng rng(3);
  int some_unknown = 0;
  for (int i = 0; i < 200; ++i) {
    const Box& region = run.world.frame.sampling_region_world;
    const Vec3 from(0.0, rng.uniform(region.min().y(), region.max().y()), 1.0);
    const Vec3 to{region.center().x(), rng.uniform(region.min().y(), region.max().y()),
                  rng.uniform(region.min().z(), region.max().z())};
    int voxels = 0;
    int unknown = 0;
    bool blocked = false;
    walk_voxels(from, to, map.resolution_m(), [&](const VoxelIndex& v) {
      ++voxels;
      blocked |= map.occupancy(v) == Occupancy::occupied;
      unknown += !blocked && map.occupancy(v) == Occupancy::unknown ? 1 : 0;
      return true;
    });
    const double gain = rvp.ray_gain(from, to);
    EXPECT_GE(gain, 0.5 * unknown / voxels - 1e-12);
    EXPECT_LE(gain, 1.0 * unknown / voxels + 1e-12);
    some_unknown += unknown > 0 ? 1 : 0;
  }
  EXPECT_GT(some_unknown, 10);
}

TEST(RvpPlanner, NearnessToARoiFallsFromOneToZeroWithinItsReach) {
  VoxelMap map;
  map.set_occupancy_log_odds(VoxelIndex(0, 0, 0), 2.0);
  map.set_roi_log_odds(VoxelIndex(0, 0, 0), 2.0);
  RoiNearness nearness;
  EXPECT_EQ(nearness.at(Vec3::Zero()), 0.0);
  nearness.rebuild(map, Box(Vec3::Constant(-1.0), Vec3::Constant(1.0)));
  EXPECT_EQ(nearness.at(Vec3(0.01, 0.01, 0.01)), 1.0);
  EXPECT_NEAR(nearness.at(Vec3(0.16, 0.01, 0.01)), 0.5, 1e-6);
  EXPECT_NEAR(nearness.at(Vec3(0.36, 0.01, 0.01)), 0.0, 1e-6);
  EXPECT_EQ(nearness.at(Vec3(5.0, 0.0, 0.0)), 0.0);
}

TEST(RvpPlanner, AsLongAsNothingIsSeenItExploresTheBorderOfWhatIsKnown) {
  test::PlannerFixture run("rvp", {});
  MapChange change = run.world.home.change;
  change.targets.roi.clear();
  change.targets.occupied.clear();
  ASSERT_FALSE(change.targets.border.empty());
  run.planner->map_changed(std::move(change));
  const Decision decision = run.planner->decide(run.q, run.work);
  ASSERT_EQ(decision.action, Decision::Action::move);
  EXPECT_EQ(decision.motion.kind, TargetKind::border);
}

TEST(RvpPlanner, WithoutFrontiersItIsStuckAfterItsPatience) {
  test::PlannerFixture run("rvp", {});
  run.planner->map_changed({});
  EXPECT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::wait);
  run.planner->grow(3.1, run.work);
  EXPECT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::stuck);
}

TEST(NbvPlanner, AsLongAsNoFruitIsKnownItTakesTheViewsOfMostUnknownVoxels) {
  PlannerOptions by_fruit;
  by_fruit.nbv.gain = NbvGain::uvpc;
  PlannerOptions by_count;
  by_count.nbv.gain = NbvGain::uvc;
  // A map without fruit: one that was never told of any.
  const auto decide = [](const PlannerOptions& options) {
    test::PlannerFixture run("nbv", options);
    const VoxelMap empty;
    PlanningScene scene = run.scene();
    scene.map = &empty;
    run.planner->begin_segment(scene);
    run.planner->map_changed(run.world.home.change);
    return run.planner->decide(run.q, run.work);
  };
  const Decision a = decide(by_fruit);
  const Decision b = decide(by_count);
  ASSERT_EQ(a.action, Decision::Action::move);
  EXPECT_EQ(a.motion.waypoints, b.motion.waypoints);
  EXPECT_FALSE(a.motion.predicted_gain.has_value());
  EXPECT_GT(b.motion.predicted_gain.value(), 0);
}

TEST(Serpentine, GoesLineByLineOverThePlaneFacingTheRow) {
  const Box workspace(Vec3(-0.95, -0.19, 0.01), Vec3(1.0, 0.6, 1.17));
  const Box region(Vec3(-0.47, 0.6, -0.3), Vec3(1.2, 1.3, 0.8));
  const auto views = serpentine(workspace, region, {});
  ASSERT_EQ(views.size() % 5, 0U);
  const std::size_t pass = views.size() / 5;
  for (std::size_t i = 0; i < pass; ++i) {
    EXPECT_NEAR(views[i].camera_base.y(), 0.35, 1e-12);
    EXPECT_TRUE((views[i].target_base - views[i].camera_base).normalized().isApprox(Vec3::UnitY()));
    if (i > 0) {
      EXPECT_LE((views[i].camera_base - views[i - 1].camera_base).norm(), 0.3 + 1e-9);
    }
  }
  std::set<std::pair<double, double>> places;
  for (std::size_t i = 0; i < pass; ++i) {
    places.emplace(views[i].camera_base.x(), views[i].camera_base.z());
  }
  EXPECT_EQ(places.size(), pass);
}

TEST(Serpentine, FacesTheOtherRowOnTheOtherSide) {
  const Box workspace(Vec3(-0.95, -0.3, 0.01), Vec3(1.0, 0.49, 1.17));
  const Box region(Vec3(-0.47, -1.0, -0.3), Vec3(1.2, -0.3, 0.8));
  const FixedView first = serpentine(workspace, region, {}).front();
  EXPECT_TRUE((first.target_base - first.camera_base).normalized().isApprox(-Vec3::UnitY()));
}

TEST(CoveragePlanner, TakesEachViewOfItsScanOnceAndWaitsAtTheEnd) {
  PlannerOptions options;
  options.coverage.scan.spacing_m = 0.6;
  test::PlannerFixture run("coverage", options);
  const Box region_base =
      transformed(run.world.frame.sampling_region_world, run.world.frame.T_world_base.inverse());
  const std::size_t scan =
      serpentine(run.world.frame.workspace_base, region_base, options.coverage.scan).size();
  std::size_t views = 0;
  Decision decision = run.planner->decide(run.q, run.work);
  for (; decision.action == Decision::Action::move; ++views) {
    ASSERT_LT(views, scan);
    decision = run.planner->decide(decision.motion.waypoints.back(), run.work);
  }
  EXPECT_GT(views, scan / 4);
  EXPECT_EQ(decision.action, Decision::Action::done);
}

TEST(VmpReleased, StandsStillForFiveSecondsBeforeASearch) {
  test::PlannerFixture run("vmp_released", {});
  EXPECT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::wait);
  run.planner->grow(4.9, run.work);
  EXPECT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::wait);
  run.planner->grow(0.2, run.work);
  EXPECT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::move);
}

TEST(VmpReleased, DoesNotGrowItsGraphWhileItSearches) {
  test::PlannerFixture run("vmp_released", {});
  run.planner->grow(5.1, run.work);
  ASSERT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::move);
  const auto tried = run.work.units(Work::candidate);
  EXPECT_GT(tried, 0);
  run.planner->grow(2.0, run.work);  // the time the search took
  EXPECT_EQ(run.work.units(Work::candidate), tried);
  run.planner->grow(2.0, run.work);  // the time the arm moves
  EXPECT_GT(run.work.units(Work::candidate), tried);
}

}  // namespace
}  // namespace canopeer
