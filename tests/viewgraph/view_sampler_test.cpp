#include "canopeer/viewgraph/view_sampler.h"

#include <gtest/gtest.h>

#include "canopeer/map/view_cast.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

TEST(ViewSampler, EveryViewKeepsAllThatIsAskedOfOne) {
  const test::PlanningFixture world;
  const ViewSamplerOptions options;
  const ViewSampler sampler(world.frame, world.robot, world.ik, options);
  const TargetSampler targets = sampler.targets_in_reach(world.home.change.targets, 0.01, {});
  const ExactChecker judge(world.robot);
  int found = 0;
  WorkMeter work;
  constexpr int kCandidates = 600;
  for (std::uint64_t i = 0; i < kCandidates; ++i) {
    Rng rng(1, "view", i);
    const auto view = sampler.sample(world.perception.map(), world.checker, targets, rng, work);
    if (!view) continue;
    ++found;
    const Vec3 camera = view->T_world_camera.translation();
    const double distance = (view->target_world - camera).norm();
    EXPECT_GE(distance, options.min_target_distance_m);
    EXPECT_LE(distance, options.max_target_distance_m);
    EXPECT_TRUE(world.frame.workspace_base.contains(world.frame.T_world_base.inverse() * camera));
    EXPECT_TRUE(world.frame.sampling_region_world.contains(view->target_world));
    // The camera really looks at the target, and nothing mapped is in between.
    const Vec3 seen = view->T_world_camera.inverse() * view->target_world;
    EXPECT_LT(seen.head<2>().norm(), 1e-6);
    EXPECT_FALSE(ray_blocked(world.perception.map(), view->target_world, camera));
    // The arm can be there: the exact judge has no objection.
    EXPECT_TRUE(world.robot.within_limits(view->q));
    EXPECT_FALSE(judge.check(view->q, world.frame.trolley, &world.perception.map()).any());
  }
  EXPECT_GE(work.units(Work::candidate), kCandidates);
  EXPECT_GT(found, kCandidates / 4);
}

}  // namespace
}  // namespace canopeer
