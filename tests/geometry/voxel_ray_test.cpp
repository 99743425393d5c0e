#include "canopeer/geometry/voxel_ray.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>
#include <vector>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr double kResolution = 0.1;

std::tuple<int, int, int> key(const VoxelIndex& v) { return {v.x(), v.y(), v.z()}; }

TEST(VoxelRay, VisitsEveryCellTheSegmentCrosses) {
  Rng rng(11);
  for (int i = 0; i < 500; ++i) {
    const Vec3 from{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const Vec3 to{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    std::set<std::tuple<int, int, int>> visited;
    std::vector<VoxelIndex> order;
    walk_voxels(from, to, kResolution, [&](const VoxelIndex& v) {
      visited.insert(key(v));
      order.push_back(v);
      return true;
    });
    // Neighbours share a face, ends are right, none is visited twice.
    for (std::size_t k = 1; k < order.size(); ++k) {
      ASSERT_EQ((order[k] - order[k - 1]).cwiseAbs().sum(), 1);
    }
    ASSERT_EQ(visited.size(), order.size());
    ASSERT_EQ(order.front(), voxel_at(from, kResolution));
    ASSERT_EQ(order.back(), voxel_at(to, kResolution));
    for (int s = 0; s <= 400; ++s) {
      const Vec3 p = from + s / 400.0 * (to - from);
      const Vec3 off = (p / kResolution).array() - (p / kResolution).array().round();
      if (off.cwiseAbs().minCoeff() < 1e-9) continue;  // on a face either side will do
      ASSERT_TRUE(visited.contains(key(voxel_at(p, kResolution))));
    }
  }
}

TEST(VoxelRay, StopsWhenTold) {
  int visits = 0;
  EXPECT_FALSE(walk_voxels(Vec3(0.05, 0.05, 0.05), Vec3(0.95, 0.05, 0.05), kResolution,
                           [&](const VoxelIndex&) { return ++visits < 3; }));
  EXPECT_EQ(visits, 3);
}

TEST(VoxelRay, HandlesARayWithinOneCellAndAlongAnAxis) {
  int visits = 0;
  const auto count = [&](const VoxelIndex&) { return ++visits > 0; };
  walk_voxels(Vec3(0.01, 0.01, 0.01), Vec3(0.02, 0.03, 0.04), kResolution, count);
  EXPECT_EQ(visits, 1);
  walk_voxels(Vec3(-0.05, 0.05, 0.05), Vec3(0.95, 0.05, 0.05), kResolution, count);
  EXPECT_EQ(visits, 1 + 11);
}

}  // namespace
}  // namespace canopeer
