#include <gtest/gtest.h>

#include "canopeer/planner/coverage/serpentine.h"
#include "planner_fixture.h"

namespace canopeer {
namespace {

TEST(SweepPlanner, GoesThroughThePointsOfTheScanWithoutStops) {
  PlannerOptions options;
  options.sweep.scan.spacing_m = 0.4;
  test::PlannerFixture run("sweep", options);
  const auto scan = serpentine(run.world.frame, options.sweep.scan);
  std::size_t next = 0;  // point of the scan
  int points = 0;
  int stretches = 0;
  Decision decision = run.planner->decide(run.q, run.work);
  for (; decision.action == Decision::Action::move; ++stretches) {
    const auto& way = decision.motion.waypoints;
    ASSERT_LT(joint_distance(way.front(), run.q), 1e-12);
    for (std::size_t i = 1; i < way.size(); ++i) {
      ASSERT_TRUE(run.world.checker.edge_free(way[i - 1], way[i]));
      // Waypoints of a way round need not be points; those that are come in their order.
      const Pose camera = run.world.robot.T_base_camera(way[i]);
      std::size_t at = next;
      while (at < scan.size() &&
             ((scan[at].camera_base - camera.translation()).norm() > 1e-6 ||
              (camera.inverse() * scan[at].target_base).head<2>().norm() > 1e-6)) {
        ++at;
      }
      if (at == scan.size()) continue;
      next = at + 1;
      ++points;
    }
    run.q = way.back();
    decision = run.planner->decide(run.q, run.work);
  }
  EXPECT_EQ(decision.action, Decision::Action::done);
  EXPECT_GT(points, static_cast<int>(scan.size()) / 3);
  EXPECT_LT(2 * stretches, points) << "several points a motion";
}

TEST(SweepPlanner, StopsWhereAStretchIsLongEnough) {
  PlannerOptions options;
  options.sweep.stretch_m = 0.01;
  test::PlannerFixture run("sweep", options);
  for (int i = 0; i < 5; ++i) {
    const Decision decision = run.planner->decide(run.q, run.work);
    ASSERT_EQ(decision.action, Decision::Action::move);
    run.q = decision.motion.waypoints.back();
  }
}

}  // namespace
}  // namespace canopeer
