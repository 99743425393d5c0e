#include <gtest/gtest.h>

#include "planner_fixture.h"

namespace canopeer {
namespace {

TEST(MapSnapshot, StaysAsItWasWhileTheNextFramesAreFused) {
  test::PlannerFixture run("vmp", {});
  const Perception& perception = run.world.perception;
  const MapSnapshot before(perception.map(), perception.field(), run.world.checker);
  const std::int64_t observed = before.map.observed_voxels();
  Rng rng(5);
  const Box& region = run.world.frame.sampling_region_world;
  std::vector<std::pair<Vec3, float>> distances;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{rng.uniform(region.min().x(), region.max().x()),
                 rng.uniform(region.min().y(), region.max().y()),
                 rng.uniform(region.min().z(), region.max().z())};
    distances.emplace_back(p, before.field.distance(p));
  }
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(run.take_view());
  EXPECT_GT(perception.map().observed_voxels(), observed);
  EXPECT_EQ(before.map.observed_voxels(), observed);
  int changed = 0;
  for (const auto& [p, distance] : distances) {
    EXPECT_EQ(before.field.distance(p), distance);
    changed += perception.field().distance(p) != distance ? 1 : 0;
  }
  EXPECT_GT(changed, 0);
}

}  // namespace
}  // namespace canopeer
