#include "canopeer/map/map_snapshots.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <thread>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/map/view_cast.h"
#include "same_map.h"

namespace canopeer {
namespace {

BlockUpdate random_update(Rng& rng, BlockKey key) {
  BlockUpdate update;
  update.key = key;
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    update.hit.slices[z] = rng.bits() & rng.bits() & rng.bits();
    update.miss.slices[z] = rng.bits() & ~update.hit.slices[z];
    update.roi_hit.slices[z] = update.hit.slices[z] & rng.bits();
  }
  return update;
}

// An observation of some of 5 × 5 × 5 blocks, some of them all free.
void observe(VoxelMap& map, Rng& rng) {
  std::vector<BlockUpdate> updates;
  std::vector<BlockKey> all_free;
  for (int i = 0; i < 125; ++i) {
    const BlockKey key = pack_block(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
    if (rng.chance(0.3)) {
      updates.push_back(random_update(rng, key));
    } else if (rng.chance(0.4)) {
      all_free.push_back(key);
    }
  }
  map.apply(updates, all_free);
}

// The same map, sharing nothing.
VoxelMap deep_copy(const VoxelMap& map) {
  VoxelMap copy(map.options());
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, map.block(key)->observed, [&](const VoxelIndex& v) {
      copy.set_occupancy_log_odds(v, map.occupancy_log_odds(v));
    });
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      if (map.roi_log_odds(v) != 0.0) copy.set_roi_log_odds(v, map.roi_log_odds(v));
    });
  }
  return copy;
}

TEST(MapSnapshots, ACopyNeverChangesAndTheOriginalGoesOnAsIfThereWereNone) {
  // TBB's own threads are not instrumented: their hand-overs would look like races.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Rng rng(seed, "frames");
    Rng same(seed, "frames");
    VoxelMap copied, alone;
    std::vector<VoxelMap> copies, expected;
    for (int frame = 0; frame < 8; ++frame) {
      observe(copied, rng);
      observe(alone, same);
      copies.push_back(copied);
      expected.push_back(deep_copy(alone));
    }
    expect_same_map(copied, alone);
    for (std::size_t i = 0; i < copies.size(); ++i) expect_same_map(copies[i], expected[i]);
    // A copy can be written to as well, and the original does not notice.
    observe(copies[3], rng);
    expect_same_map(copied, alone);
  }
}

TEST(MapSnapshots, ThereIsNoneBeforeTheFirst) { EXPECT_EQ(MapSnapshots().latest(), nullptr); }

// One thread fuses and publishes, three read what they get; meant for the tsan preset. A snapshot
// that changed under a reader would not add up.
TEST(MapSnapshots, ReadersSeeWholeFramesWhileTheNextOneIsFused) {
  constexpr int kFrames = 40;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);  // as above
  MapSnapshots snapshots;
  std::atomic<bool> done = false;
  std::atomic<int> reads = 0;
  const auto read = [&] {
    std::uint64_t last = 0;
    bool more = true;
    while (more) {
      more = !done.load();
      const auto map = snapshots.latest();
      if (map == nullptr) continue;
      EXPECT_GE(map->version(), last);
      last = map->version();
      std::int64_t observed = 0, occupied = 0, roi = 0;
      map->for_each_block([&](BlockKey key, const BlockMasks& masks) {
        observed += masks.observed.count();
        occupied += masks.occupied.count();
        roi += masks.roi.count();
        EXPECT_LE(map->block_version(key), map->version());
      });
      EXPECT_EQ(observed, map->observed_voxels());
      EXPECT_EQ(occupied, map->occupied_voxels());
      EXPECT_EQ(roi, map->roi_voxels());
      ViewFan fan;
      fan.columns = fan.rows = 4;
      fan.depth_m = 0.3;
      const Pose T_world_camera = look_at(Vec3(0.01, 0.02, -0.3), Vec3(0.0, 0.0, 0.0));
      EXPECT_LE(cast_view(*map, T_world_camera, fan).unknown.count(), 16 * 200);
      ++reads;
    }
  };
  std::vector<std::jthread> readers;
  for (int i = 0; i < 3; ++i) readers.emplace_back(read);
  VoxelMap map;
  Rng rng(1, "frames");
  for (int frame = 0; frame < kFrames; ++frame) {
    observe(map, rng);
    snapshots.publish(map);
  }
  done = true;
  readers.clear();
  EXPECT_GT(reads.load(), 0);
  EXPECT_EQ(snapshots.latest()->version(), static_cast<std::uint64_t>(kFrames));
}

}  // namespace
}  // namespace canopeer
