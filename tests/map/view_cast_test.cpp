#include "canopeer/map/view_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "ball_scene.h"
#include "canopeer/map/views/view_caster.h"

namespace canopeer {
namespace {

using Voxels = std::set<std::array<int, 3>>;

Voxels as_set(const VoxelSet& voxels) {
  Voxels set;
  voxels.for_each([&](const VoxelIndex& v) { set.insert({v.x(), v.y(), v.z()}); });
  return set;
}

TEST(ViewCast, FindsTheVoxelsAPlainWalkerFinds) {
  const VoxelMap map = BallScene::map(1, 2);
  Rng rng(1, "views");
  for (int i = 0; i < 20; ++i) {
    const Pose T_world_camera = BallScene::random_camera(rng);
    ViewFan fan;
    fan.columns = 9;
    fan.rows = 7;
    Voxels expected;
    std::set<BlockKey> crossed;
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 9; ++column) {
        const Vec3 end(std::tan(fan.fov_x_rad / 2) * (column / 4.0 - 1.0),
                       std::tan(fan.fov_y_rad / 2) * (row / 3.0 - 1.0), 1.0);
        walk_voxels(T_world_camera.translation(), T_world_camera * end, map.resolution_m(),
                    [&](const VoxelIndex& v) {
                      crossed.insert(block_key(v));
                      if (map.occupancy(v) == Occupancy::occupied) return false;
                      if (map.occupancy(v) == Occupancy::unknown) {
                        expected.insert({v.x(), v.y(), v.z()});
                      }
                      return true;
                    });
      }
    }
    const ViewCast cast = cast_view(map, T_world_camera, fan);
    EXPECT_EQ(as_set(cast.unknown), expected) << "view " << i;
    EXPECT_EQ(cast.unknown.count(), static_cast<std::int64_t>(expected.size()));
    EXPECT_EQ(cast.touched.keys(), std::vector<BlockKey>(crossed.begin(), crossed.end()));
  }
}

TEST(ViewCast, FindsTheSameWithAnyInstructionSet) {
  const VoxelMap map = BallScene::map(1, 2);
  Rng rng(4, "levels");
  for (int i = 0; i < 10; ++i) {
    const Vec3 from = BallScene::random_camera(rng).translation();
    std::vector<Vec3> ends(1 + rng.index(40));
    for (Vec3& end : ends) {
      end = from + Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    }
    if (i % 3 == 0) ends.front() = from + Vec3(0.001, 0.0, 0.0);  // goes alone
    const Box world(from - Vec3::Ones(), from + Vec3::Ones());
    const double max_unknown_m = i % 2 == 0 ? 0.2 : 10.0;
    const auto cast = [&](SimdLevel level) {
      ViewCaster caster(map, world, false, level);
      caster.cast(from, ends, max_unknown_m);
      return caster.result();
    };
    const ViewCast expected = cast(SimdLevel::scalar);
    EXPECT_FALSE(expected.unknown.empty());
    for (const SimdLevel level : kSimdLevels) {
      if (level > best_simd_level()) continue;
      const ViewCast found = cast(level);
      EXPECT_EQ(found.unknown, expected.unknown) << simd_level_name(level);
      EXPECT_EQ(found.touched, expected.touched) << simd_level_name(level);
    }
  }
}

TEST(ViewCast, EndsARayAfterItsShareOfUnknownSpace) {
  const VoxelMap map = BallScene::map(1, 2);
  Rng rng(1, "short views");
  for (int i = 0; i < 20; ++i) {
    const Pose T_world_camera = BallScene::random_camera(rng);
    ViewFan fan;
    fan.columns = fan.rows = 5;
    fan.max_unknown_m = 0.02 * i;  // nothing: a voxel still
    Voxels expected;
    for (int ray = 0; ray < 25; ++ray) {
      const Vec3 end(std::tan(fan.fov_x_rad / 2) * (ray % 5 / 2.0 - 1.0),
                     std::tan(fan.fov_y_rad / 2) * (ray / 5 / 2.0 - 1.0), 1.0);
      const Vec3 to = T_world_camera * end;
      int crossed = 0, unknown = 0;
      walk_voxels(T_world_camera.translation(), to, map.resolution_m(),
                  [&](const VoxelIndex&) { return ++crossed > 0; });
      const double length_m = (to - T_world_camera.translation()).norm();
      const double limit = std::max(1.0, std::ceil(crossed * fan.max_unknown_m / length_m));
      walk_voxels(T_world_camera.translation(), to, map.resolution_m(), [&](const VoxelIndex& v) {
        if (map.occupancy(v) == Occupancy::occupied) return false;
        if (map.occupancy(v) == Occupancy::free) return true;
        expected.insert({v.x(), v.y(), v.z()});
        return ++unknown < limit;
      });
    }
    EXPECT_EQ(as_set(cast_view(map, T_world_camera, fan).unknown), expected) << "view " << i;
  }
}

// Rays from lattice points cross edges and corners of voxels, where ties decide; clear blocks are
// passed in one go.
TEST(ViewCast, LeapsOverClearBlocksOntoTheVoxelsAPlainWalkerFinds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed, "clear blocks");
    VoxelMap map;
    std::vector<BlockUpdate> updates;
    for (int i = 0; i < 6 * 6 * 6; ++i) {
      if (rng.chance(0.3)) continue;
      BlockUpdate& update = updates.emplace_back();
      update.key = pack_block(i % 6 - 3, i / 6 % 6 - 3, i / 36 - 3);
      update.miss = VoxelMask::all();
      if (rng.chance(0.2)) update.miss.slices[rng.index(8)] &= rng.bits();
      if (rng.chance(0.1)) update.hit.slices[rng.index(8)] = rng.bits() & rng.bits() & rng.bits();
      update.miss -= update.hit;
    }
    map.apply(updates);
    const auto lattice = [&] { return 0.01 * static_cast<double>(rng.index(20)) - 0.1; };
    const bool tied = seed % 2 == 0;
    const Vec3 from = tied ? Vec3(lattice(), lattice(), lattice())
                           : Vec3{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), 0.0123};
    Pose T_world_camera = look_at(from, from + Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), 1.0});
    if (tied) T_world_camera.linear() = Eigen::Matrix3d::Identity();
    ViewFan fan;
    fan.columns = fan.rows = 5;
    fan.depth_m = 0.2;
    if (tied) fan.fov_x_rad = fan.fov_y_rad = std::numbers::pi / 2.0;  // along diagonals
    Voxels expected;
    for (int i = 0; i < 25; ++i) {
      const Vec3 end(std::tan(fan.fov_x_rad / 2) * (i % 5 / 2.0 - 1.0),
                     std::tan(fan.fov_y_rad / 2) * (i / 5 / 2.0 - 1.0), 1.0);
      walk_voxels(from, T_world_camera * (fan.depth_m * end), 0.01, [&](const VoxelIndex& v) {
        const Occupancy state = map.occupancy(v);
        if (state == Occupancy::unknown) expected.insert({v.x(), v.y(), v.z()});
        return state != Occupancy::occupied;
      });
    }
    EXPECT_EQ(as_set(cast_view(map, T_world_camera, fan).unknown), expected) << "seed " << seed;
  }
}

TEST(ViewCast, SeesNothingBehindAWallAndAllOfAnEmptyMap) {
  std::vector<VoxelIndex> wall;
  for (int y = -60; y < 60; ++y) {
    for (int z = -60; z < 60; ++z) wall.push_back({30, y, z});
  }
  const Pose T_world_camera = look_at(Vec3(0.105, 0.001, 0.001), Vec3(1.0, 0.0, 0.0));
  const ViewCast cast = cast_view(map_of({}, wall), T_world_camera);
  cast.unknown.for_each([](const VoxelIndex& v) { EXPECT_LT(v.x(), 30); });
  EXPECT_GT(cast.unknown.count(), 0);
  EXPECT_GT(cast_view(VoxelMap(), T_world_camera).unknown.count(), cast.unknown.count());
}

TEST(ViewCast, HoldsUntilACrossedBlockChanges) {
  const Pose T_world_camera = look_at(Vec3(0.001, 0.001, 0.001), Vec3(1.0, 0.0, 0.0));
  const ViewCast cast = cast_view(VoxelMap(), T_world_camera);
  const BlockKey crossed = block_key(voxel_at(Vec3(0.5, 0.0, 0.0), 0.01));
  const BlockKey behind = block_key(voxel_at(Vec3(-0.5, 0.0, 0.0), 0.01));
  EXPECT_TRUE(still_valid(cast, {}));
  EXPECT_TRUE(still_valid(cast, {behind}));
  EXPECT_FALSE(still_valid(cast, {behind, crossed}));
}

TEST(BlockSet, HoldsTheBlocksItIsMadeOfAndNoOthers) {
  Rng rng(3, "blocks");
  std::set<BlockKey> plain;
  const auto index = [&] { return static_cast<int>(rng.index(12)) - 6; };
  for (int i = 0; i < 200; ++i) plain.insert(pack_block(index(), index(), index()));
  const std::vector<BlockKey> keys(plain.begin(), plain.end());
  const BlockSet blocks(keys);
  EXPECT_EQ(blocks.keys(), keys);
  for (int x = -9; x < 9; ++x) {
    for (int y = -9; y < 9; ++y) {
      for (int z = -9; z < 9; ++z) {
        const BlockKey key = pack_block(x, y, z);
        ASSERT_EQ(blocks.contains(key), plain.count(key) == 1);
      }
    }
  }
  EXPECT_EQ(BlockSet(), BlockSet(std::vector<BlockKey>{}));
  EXPECT_FALSE(BlockSet().contains(pack_block(0, 0, 0)));
}

TEST(RayBlocked, ByAnOccupiedVoxelInBetweenButNotByAnIgnoredOne) {
  const VoxelMap map = map_of({{1, 0, 0}}, {{20, 0, 0}});
  const Vec3 a(0.005, 0.005, 0.005), b(0.405, 0.005, 0.005), c(0.15, 0.005, 0.005);
  EXPECT_TRUE(ray_blocked(map, a, b));
  EXPECT_TRUE(ray_blocked(map, b, a));
  EXPECT_FALSE(ray_blocked(map, a, c));
  EXPECT_FALSE(ray_blocked(map, a, b, 0.21));
  EXPECT_TRUE(ray_blocked(map, a, b, 0.19));
  EXPECT_FALSE(ray_blocked(map, a, a));
}

TEST(VoxelSet, UnionLosesNoVoxelAndCountsWhatIsNew) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed, "sets");
    const auto random_set = [&rng] {
      std::vector<VoxelSet::Block> blocks;
      for (int b = -6; b < 6; ++b) {
        if (rng.chance(0.5)) continue;
        VoxelSet::Block& block = blocks.emplace_back();
        block.key = pack_block(b % 3, b, -b);
        for (std::uint64_t& slice : block.mask.slices) {
          slice = rng.chance(0.3) ? 0 : rng.bits() & rng.bits();
        }
        if (rng.chance(0.1)) block.mask = {};
      }
      std::reverse(blocks.begin(), blocks.end());
      return VoxelSet(blocks);
    };
    const VoxelSet a = random_set(), b = random_set();
    VoxelSet both = a;
    both.merge(b);
    Voxels expected = as_set(a);
    expected.merge(as_set(b));
    EXPECT_EQ(as_set(both), expected) << "seed " << seed;
    EXPECT_EQ(both.count(), static_cast<std::int64_t>(expected.size()));
    EXPECT_EQ(a.count_new(b), both.count() - a.count());
    EXPECT_EQ(both.count_new(a), 0);
    a.for_each([&](const VoxelIndex& v) { EXPECT_TRUE(both.contains(v)); });
    EXPECT_FALSE(both.contains({1000, 1000, 1000}));
  }
}

}  // namespace
}  // namespace canopeer
