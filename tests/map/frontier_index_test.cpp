#include "canopeer/map/frontier_index.h"

#include <gtest/gtest.h>

#include "ball_scene.h"

namespace canopeer {
namespace {

void expect_from_scratch(const FrontierIndex& index, const VoxelMap& map, const char* when) {
  const FrontierTargets kept = index.targets();
  const FrontierTargets fresh = extract_frontiers(map, index.world());
  EXPECT_EQ(kept.roi, fresh.roi) << when;
  EXPECT_EQ(kept.occupied, fresh.occupied) << when;
  EXPECT_EQ(kept.border, fresh.border) << when;
}

TEST(FrontierIndex, KeepsWhatIsExtractedFromScratchFrameByFrame) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const BallScene scene = BallScene::random(seed, 60);
    VoxelMapOptions options;
    options.resolution_m = 0.02;
    VoxelMap map(options);
    const Box world(Vec3(0.111, -0.5, -0.4), Vec3(1.3, 0.7, 0.333));
    FrontierIndex index(world, options.resolution_m);
    expect_from_scratch(index, map, "empty");
    Rng rng(seed, "cameras");
    for (int frame = 0; frame < 6; ++frame) {
      const auto view =
          scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(120, 90, 1.396));
      index.update(map, fuse(map, view.frame, view.roi).changed);
      expect_from_scratch(index, map, "fused");
    }
    FrontierIndex late(world, options.resolution_m);
    late.rebuild(map);
    expect_from_scratch(late, map, "rebuilt");
  }
}

// Noise makes and unmakes targets of all kinds, at all block borders, inside the box and beside it.
TEST(FrontierIndex, KeepsWhatIsExtractedFromScratchOnNoise) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed, "noise");
    VoxelMap map;
    const Box world(Vec3(-0.13, -0.08, -0.21), Vec3(0.1, 0.16, 0.0799));
    FrontierIndex index(world, 0.01);
    for (int frame = 0; frame < 25; ++frame) {
      std::vector<BlockUpdate> updates;
      std::vector<BlockKey> all_free;
      for (int i = 0; i < 6 * 6 * 6; ++i) {
        const BlockKey key = pack_block(i % 6 - 3, i / 6 % 6 - 3, i / 36 - 4);
        if (rng.chance(0.05)) all_free.push_back(key);
        if (!rng.chance(0.1) || (!all_free.empty() && all_free.back() == key)) continue;
        BlockUpdate& update = updates.emplace_back();
        update.key = key;
        for (std::size_t z = 0; z < kBlockSide; ++z) {
          update.hit.slices[z] = rng.bits() & rng.bits() & rng.bits() & rng.bits();
          update.miss.slices[z] = (rng.bits() | rng.bits()) & ~update.hit.slices[z];
          update.roi_hit.slices[z] = update.hit.slices[z] & rng.bits() & rng.bits();
          update.roi_miss.slices[z] = update.hit.slices[z] & ~update.roi_hit.slices[z];
        }
      }
      index.update(map, map.apply(updates, all_free).changed);
      expect_from_scratch(index, map, "noise");
      if (HasFailure()) {
        FAIL() << "seed " << seed << " frame " << frame;
      }
    }
  }
}

TEST(FrontierIndex, OfAnEmptyBoxHoldsNothing) {
  VoxelMap map = BallScene::map(1, 1);
  FrontierIndex index(Box(), map.resolution_m());
  index.rebuild(map);
  index.update(map, map.block_keys());
  EXPECT_TRUE(index.targets().border.empty());
}

}  // namespace
}  // namespace canopeer
