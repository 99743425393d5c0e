#include "canopeer/map/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "ball_scene.h"
#include "canopeer/map/files/map_cloud.h"
#include "canopeer/map/storage/block_key_order.h"
#include "canopeer/map/storage/voxel_bounds.h"

namespace canopeer {
namespace {

double log_odds(double p) { return std::log(p / (1.0 - p)); }

TEST(BlockKeys, AreSortedWhereverTheyLie) {
  Rng rng(1, "keys");
  for (const int reach : {1, 3, 20, 150, kBlockIndexLimit - 1}) {
    for (const std::size_t wanted : {0U, 1U, 70U, 3000U}) {
      std::vector<BlockKey> keys;
      const auto index = [&] { return static_cast<int>(rng.index(2U * reach + 1)) - reach; };
      for (std::size_t i = 0; i < wanted; ++i) {
        const int x = index(), y = index();
        keys.push_back(pack_block(x, y, index()));
      }
      std::sort(keys.begin(), keys.end());
      keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
      std::vector<BlockKey> mixed = keys;
      for (std::size_t i = mixed.size(); i > 1; --i) std::swap(mixed[i - 1], mixed[rng.index(i)]);
      sort_keys(mixed);
      EXPECT_EQ(mixed, keys) << wanted << " within " << reach;
    }
  }
}

TEST(Block, KeysRoundTripAndSortByZThenYThenX) {
  for (const VoxelIndex& v : {VoxelIndex(0, 0, 0), VoxelIndex(-1, -8, -9), VoxelIndex(7, 8, -70000),
                              VoxelIndex(-1, 7, 15)}) {
    const VoxelIndex origin = block_origin(block_key(v));
    EXPECT_TRUE(((v - origin).array() >= 0).all() && ((v - origin).array() < kBlockSide).all());
    VoxelMask mask;
    mask.set(v);
    for_each_voxel(block_key(v), mask, [&](const VoxelIndex& w) { EXPECT_EQ(w, v); });
    EXPECT_EQ(mask.count(), 1);
  }
  EXPECT_LT(block_key({100, 100, -1}), block_key({-100, -100, 0}));
  EXPECT_LT(block_key({100, -1, 0}), block_key({-100, 0, 0}));
  EXPECT_LT(block_key({-1, 0, 0}), block_key({0, 0, 0}));
}

TEST(BlockDirectory, FindsWhatWasAddedInOrderThroughGrowth) {
  BlockDirectory directory;
  for (int i = 0; i < 5000; ++i) {
    EXPECT_EQ(directory.find_or_add(pack_block(i % 17 - 8, i / 17 - 150, i % 5)),
              static_cast<std::uint32_t>(i));
  }
  for (int i = 0; i < 5000; ++i) {
    EXPECT_EQ(directory.find(pack_block(i % 17 - 8, i / 17 - 150, i % 5)), i);
  }
  EXPECT_FALSE(directory.find(pack_block(9, 9, 9)).has_value());
}

TEST(VoxelBounds, MaskHoldsTheVoxelsWithCentresInside) {
  const Box world(Vec3(-0.013, -0.2, 0.031), Vec3(0.0449, 0.07501, 0.05499));
  const VoxelBounds bounds = VoxelBounds::inside(world, 0.01);
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 16; ++y) {
      for (int x = -8; x < 8; ++x) {
        const VoxelIndex v(x, y, z);
        EXPECT_EQ(bounds.mask(block_key(v)).test(v), world.contains(voxel_centre(v, 0.01)));
      }
    }
  }
  EXPECT_TRUE(VoxelBounds::inside(Box(), 0.01).empty());
}

// Random updates against a plain map of sums in double precision.
TEST(VoxelMap, SumsClampsAndCountsLikeAPlainTable) {
  struct Cell {
    double occupancy = 0.0, roi = 0.0;
    bool observed = false, roi_seen = false;
  };
  const auto step = [](double& sum, double by) {
    sum = std::clamp(sum + by, log_odds(0.12), log_odds(0.97));
  };
  Rng rng(7, "updates");
  VoxelMap map;
  std::map<std::array<int, 3>, Cell> table;
  for (int round = 0; round < 12; ++round) {
    std::vector<BlockUpdate> updates;
    for (int b = 0; b < 6; ++b) {
      if (rng.chance(0.3)) continue;
      BlockUpdate& update = updates.emplace_back();
      update.key = pack_block(b - 3, 2 * b - 5, -b);
      for_each_voxel(update.key, VoxelMask::all(), [&](const VoxelIndex& v) {
        const double kind = rng.uniform();
        Cell& cell = table[{v.x(), v.y(), v.z()}];
        if (kind < 0.2) {
          const bool fruit = rng.chance(0.4);
          update.hit.set(v);
          (fruit ? update.roi_hit : update.roi_miss).set(v);
          step(cell.occupancy, log_odds(0.7));
          step(cell.roi, fruit ? log_odds(0.7) : log_odds(0.4));
          cell.observed = cell.roi_seen = true;
        } else if (kind < 0.6) {
          update.miss.set(v);
          step(cell.occupancy, log_odds(0.4));
          cell.observed = true;
        }
      });
    }
    map.apply(updates);
  }
  std::int64_t observed = 0, occupied = 0, roi = 0;
  for (const auto& [at, cell] : table) {
    const VoxelIndex v(at[0], at[1], at[2]);
    const bool is_occupied = cell.observed && cell.occupancy >= 0.0;
    const bool is_roi = cell.roi_seen && cell.roi >= 0.0;
    EXPECT_EQ(map.occupancy(v), !cell.observed ? Occupancy::unknown
                                : is_occupied  ? Occupancy::occupied
                                               : Occupancy::free);
    EXPECT_EQ(map.is_roi(v), is_roi);
    EXPECT_NEAR(map.occupancy_log_odds(v), cell.occupancy, 12 * 2.5e-4);  // rounding of 12 steps
    EXPECT_NEAR(map.roi_log_odds(v), cell.roi, 12 * 2.5e-4);
    observed += cell.observed;
    occupied += is_occupied;
    roi += is_roi;
  }
  EXPECT_EQ(map.observed_voxels(), observed);
  EXPECT_EQ(map.occupied_voxels(), occupied);
  EXPECT_EQ(map.roi_voxels(), roi);
  EXPECT_EQ(map.occupancy({1000, 0, 0}), Occupancy::unknown);
}

TEST(VoxelMap, ABlockSeenFreeAgainAndAgainSettlesAndStillTakesHits) {
  VoxelMap map;
  BlockUpdate free;
  free.key = pack_block(0, 0, 0);
  free.miss = VoxelMask::all();
  for (int i = 0; i < 10; ++i) {
    const UpdateResult result = map.apply({&free, 1});
    EXPECT_EQ(result.updated_voxels, kBlockVoxels);
    EXPECT_EQ(result.changed.size(), i == 0 ? 1U : 0U);
  }
  const VoxelIndex v(3, 4, 5);
  EXPECT_NEAR(map.occupancy_log_odds(v), log_odds(0.12), 2.5e-4);
  BlockUpdate hit;
  hit.key = free.key;
  hit.hit.set(v);
  map.apply({&hit, 1});
  EXPECT_NEAR(map.occupancy_log_odds(v), log_odds(0.12) + log_odds(0.7), 5e-4);
  map.apply({&free, 1});
  map.apply({&hit, 1});
  EXPECT_NEAR(map.occupancy_log_odds(v), log_odds(0.12) + 2 * log_odds(0.7) + log_odds(0.4), 1e-3);
  map.apply({&hit, 1});
  map.apply({&hit, 1});
  EXPECT_EQ(map.occupancy(v), Occupancy::occupied);
}

TEST(VoxelMap, ReportsExactlyTheBlocksWhoseMasksChanged) {
  VoxelMap map;
  BlockUpdate update;
  update.key = pack_block(-1, 0, 0);
  update.miss.set({-1, 0, 0});
  const UpdateResult first = map.apply({&update, 1});
  EXPECT_EQ(first.changed, std::vector<BlockKey>{update.key});
  EXPECT_EQ(first.newly_known, 1);
  EXPECT_EQ(map.block_version(update.key), 1U);
  const UpdateResult second = map.apply({&update, 1});
  EXPECT_TRUE(second.changed.empty());
  EXPECT_EQ(second.newly_known, 0);
  EXPECT_EQ(second.updated_voxels, 1);
  EXPECT_EQ(map.block_version(update.key), 1U);
}

TEST(VoxelMap, RejectsProbabilitiesThatMakeNoSense) {
  VoxelMapOptions options;
  EXPECT_TRUE(options.validate().has_value());
  options.hit_probability = 0.4;
  EXPECT_FALSE(options.validate().has_value());
  options = {};
  options.resolution_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(options.validate().has_value());
}

TEST(VoxelMap, VisitsOccupiedAndRoiVoxelsOfABoxInOrder) {
  const VoxelMap map =
      map_of({{0, 0, 0}}, {{9, 0, 0}, {-1, 0, 0}, {3, 3, 3}, {0, 1, 0}, {50, 0, 0}},
             {{3, 3, 3}, {-1, 0, 0}});
  const Box world(Vec3(-0.5, -0.5, -0.5), Vec3(0.2, 0.5, 0.5));
  std::vector<VoxelIndex> occupied, roi;
  map.for_each_occupied(world, [&](const VoxelIndex& v) { occupied.push_back(v); });
  map.for_each_roi(world, [&](const VoxelIndex& v) { roi.push_back(v); });
  EXPECT_EQ(occupied, (std::vector<VoxelIndex>{{-1, 0, 0}, {0, 1, 0}, {3, 3, 3}, {9, 0, 0}}));
  EXPECT_EQ(roi, (std::vector<VoxelIndex>{{-1, 0, 0}, {3, 3, 3}}));
  const PointCloud cloud = occupied_cloud(map);
  ASSERT_EQ(cloud.points.size(), 5U);
  EXPECT_TRUE(cloud.points[0].isApprox(Eigen::Vector3f(-0.005F, 0.005F, 0.005F)));
  EXPECT_EQ(cloud.colors[0], MapCloudOptions{}.roi);
  EXPECT_EQ(cloud.colors[1], MapCloudOptions{}.other);
}

// Blocks whose observed voxels agree keep one value: nothing of that is to be seen.
TEST(VoxelMap, IsWhatSteppingVoxelByVoxelGives) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed, "updates");
    VoxelMapOptions options;
    if (seed % 3 == 0) options.occupied_threshold = 0.35;  // one miss leaves a voxel occupied
    VoxelMap map(options);
    const auto steps_of = [](double p) { return std::lround(2048.0 * log_odds(p)); };
    const BlockKey key = pack_block(-1, 2, 0);
    std::array<long, kBlockVoxels> expected{};
    VoxelMask observed, seen;
    for (std::uint64_t& slice : seen.slices) slice = rng.bits();  // a view that comes back
    for (int frame = 0; frame < 20; ++frame) {
      BlockUpdate update;
      update.key = key;
      update.miss = rng.chance(0.3) ? VoxelMask::all() -= seen : seen;
      if (rng.chance(0.1)) update.miss.slices[rng.index(8)] &= rng.bits();
      if (rng.chance(0.1)) update.hit.slices[rng.index(8)] = rng.bits() & rng.bits();
      update.miss -= update.hit;
      if (rng.chance(0.2)) {
        update.hit = {};
        update.miss = VoxelMask::all();
        map.apply({}, {{key}});
      } else {
        map.apply({{update}});
      }
      observed |= update.hit;
      observed |= update.miss;
      for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
        long& value = expected[voxel_offset(v)];
        const bool hit = update.hit.test(v), miss = update.miss.test(v);
        if (hit) value += steps_of(options.hit_probability);
        if (miss) value += steps_of(options.miss_probability);
        value = std::clamp(value, steps_of(options.clamp_min), steps_of(options.clamp_max));
        ASSERT_EQ(map.occupancy_log_odds(v), static_cast<double>(value) / 2048.0)
            << "seed " << seed << ", frame " << frame;
        const bool occupied = value >= steps_of(options.occupied_threshold);
        ASSERT_EQ(map.occupancy(v), !observed.test(v) ? Occupancy::unknown
                                    : occupied        ? Occupancy::occupied
                                                      : Occupancy::free);
      });
      ASSERT_EQ(map.observed_voxels(), observed.count());
      ASSERT_EQ(map.occupied_voxels(), map.block(key)->occupied.count());
    }
  }
}

}  // namespace
}  // namespace canopeer
