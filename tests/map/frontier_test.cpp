#include "canopeer/map/frontier.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ball_scene.h"

namespace canopeer {
namespace {

// The definition, voxel by voxel.
FrontierTargets by_definition(const VoxelMap& map, const Box& world) {
  const auto any_neighbour = [&](const VoxelIndex& v, int max_steps, auto&& is) {
    for (int i = 0; i < 27; ++i) {
      const VoxelIndex d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const int steps = d.cwiseAbs().sum();
      if (steps >= 1 && steps <= max_steps && is(VoxelIndex(v + d))) return true;
    }
    return false;
  };
  const auto unknown = [&](const VoxelIndex& v) { return map.occupancy(v) == Occupancy::unknown; };
  const auto occupied = [&](const VoxelIndex& v) {
    return map.occupancy(v) == Occupancy::occupied;
  };
  const auto roi = [&](const VoxelIndex& v) { return map.is_roi(v); };
  FrontierTargets targets;
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      if (map.occupancy(v) != Occupancy::free) return;
      if (!world.contains(voxel_centre(v, map.resolution_m()))) return;
      if (any_neighbour(v, 2, roi) && any_neighbour(v, 2, unknown)) targets.roi.push_back(v);
      if (!any_neighbour(v, 1, unknown)) return;
      (any_neighbour(v, 1, occupied) ? targets.occupied : targets.border).push_back(v);
    });
  }
  return targets;
}

void expect_same(const FrontierTargets& a, const FrontierTargets& b) {
  EXPECT_EQ(a.roi, b.roi);
  EXPECT_EQ(a.occupied, b.occupied);
  EXPECT_EQ(a.border, b.border);
}

TEST(Frontier, IsTheDefinitionOnFusedScenes) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const VoxelMap map = BallScene::map(seed, 2);
    const Box world(Vec3(0.111, -0.5, -0.4), Vec3(1.3, 0.7, 0.333));
    const FrontierTargets targets = extract_frontiers(map, world);
    expect_same(targets, by_definition(map, world));
    EXPECT_FALSE(targets.roi.empty());
    EXPECT_FALSE(targets.occupied.empty());
    EXPECT_FALSE(targets.border.empty());
  }
}

// Every combination of states meets at every block face, edge and corner.
TEST(Frontier, IsTheDefinitionOnNoiseAcrossBlockBorders) {
  Rng rng(4, "noise");
  VoxelMap map;
  for (int z = -9; z < 10; ++z) {
    for (int y = -9; y < 10; ++y) {
      for (int x = -9; x < 10; ++x) {
        const double kind = rng.uniform();
        if (kind < 0.25) continue;
        map.set_occupancy_log_odds({x, y, z}, kind < 0.3 ? 1.0 : -1.0);
        if (rng.chance(0.02)) map.set_roi_log_odds({x, y, z}, 1.0);
      }
    }
  }
  const Box everywhere(Vec3::Constant(-1e9), Vec3::Constant(1e9));
  expect_same(extract_frontiers(map, everywhere), by_definition(map, everywhere));
}

TEST(Frontier, OfAnEmptyMapOrBoxIsEmpty) {
  const FrontierTargets none = extract_frontiers(VoxelMap(), Box(Vec3::Zero(), Vec3::Ones()));
  EXPECT_TRUE(none.roi.empty() && none.occupied.empty() && none.border.empty());
  const FrontierTargets boxless = extract_frontiers(BallScene::map(1, 1), Box());
  EXPECT_TRUE(boxless.roi.empty() && boxless.occupied.empty() && boxless.border.empty());
}

}  // namespace
}  // namespace canopeer
