#include "canopeer/map/fusion.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "ball_scene.h"
#include "octomap_oracle.h"

namespace canopeer {
namespace {

const CameraIntrinsics kSmall = CameraIntrinsics::from_fov(160, 120, 1.396);

// A camera that looks along +x from a point off all voxel borders.
RgbdFrame flat_frame(float depth) {
  RgbdFrame frame;
  frame.intrinsics = kSmall;
  frame.T_world_camera = look_at(Vec3(0.003, 0.004, 0.002), Vec3(1.003, 0.004, 0.002));
  frame.depth = DepthImage(kSmall.width, kSmall.height, depth);
  return frame;
}

TEST(Fusion, AWallIsOccupiedFreeInFrontAndUnknownBehind) {
  for (const auto fuse_mode : {&fuse, &fuse_exact}) {
    VoxelMap map;
    const FuseResult result = fuse_mode(map, flat_frame(0.512F), {}, {});
    EXPECT_EQ(result.fused_points, 160 * 120);
    EXPECT_EQ(result.newly_known, map.observed_voxels());
    for (int y = -6; y <= 6; ++y) {
      for (int x = 10; x < 51; ++x) EXPECT_EQ(map.occupancy({x, y, 0}), Occupancy::free);
      EXPECT_EQ(map.occupancy({51, y, 0}), Occupancy::occupied);
      for (int x = 52; x < 60; ++x) EXPECT_EQ(map.occupancy({x, y, 0}), Occupancy::unknown);
    }
    EXPECT_EQ(map.occupancy({-10, 0, 0}), Occupancy::unknown);
    EXPECT_EQ(map.roi_voxels(), 0);
  }
}

TEST(Fusion, PixelsWithoutAUsableDepthAreNoEndPoints) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float depth : {0.0F, -1.0F, inf, -inf, nan}) {
    VoxelMap map;
    const FuseResult result = fuse(map, flat_frame(depth), Mask(160, 120, 1));
    EXPECT_EQ(result.fused_points, 0);
    EXPECT_EQ(map.observed_voxels(), 0);
    EXPECT_TRUE(result.changed.empty());
  }
}

TEST(Fusion, SpaceIsFreedUpToTheRangeWhereTheSurfaceIsBeyond) {
  FusionOptions options;
  options.max_range_m = 0.4;
  VoxelMap map;
  EXPECT_EQ(fuse(map, flat_frame(0.8F), {}, options).fused_points, 0);
  EXPECT_EQ(map.occupied_voxels(), 0);
  EXPECT_EQ(map.occupancy({38, 0, 0}), Occupancy::free);
  EXPECT_EQ(map.occupancy({41, 0, 0}), Occupancy::unknown);
  VoxelMap cleared;
  options.clear_no_return = true;
  fuse(cleared, flat_frame(0.0F), {}, options);
  EXPECT_EQ(cleared.observed_voxels(), map.observed_voxels());
}

TEST(Fusion, RoiChangesAtEndPointsOnlyAndFruitWins) {
  const RgbdFrame frame = flat_frame(0.512F);
  Mask roi(160, 120);
  roi.at(80, 60) = 1;  // one fruit pixel among several that end in the same voxel
  VoxelMap map;
  fuse(map, frame, roi);
  EXPECT_EQ(map.roi_voxels(), 1);
  const Vec3 p = frame.T_world_camera * (0.512 * kSmall.ray(80, 60));
  EXPECT_TRUE(map.is_roi(voxel_at(p, 0.01)));
  EXPECT_NEAR(map.roi_log_odds(voxel_at(p, 0.01)), std::log(0.7 / 0.3), 2.5e-4);
  EXPECT_NEAR(map.roi_log_odds({51, 10, 10}), std::log(0.4 / 0.6), 2.5e-4);
  EXPECT_EQ(map.roi_log_odds({30, 0, 0}), 0.0);
  fuse(map, frame, {});  // a frame that was not segmented says nothing about ROI
  EXPECT_NEAR(map.roi_log_odds(voxel_at(p, 0.01)), std::log(0.7 / 0.3), 2.5e-4);
}

TEST(Fusion, RepeatedFramesClampAndStopChangingBlocks) {
  VoxelMap map;
  for (int i = 0; i < 30; ++i) fuse(map, flat_frame(0.512F), {});
  EXPECT_NEAR(map.occupancy_log_odds({51, 0, 0}), std::log(0.97 / 0.03), 5e-4);
  EXPECT_NEAR(map.occupancy_log_odds({30, 0, 0}), std::log(0.12 / 0.88), 5e-4);
  const FuseResult again = fuse(map, flat_frame(0.512F), {});
  EXPECT_TRUE(again.changed.empty());
  EXPECT_EQ(again.newly_known, 0);
  EXPECT_GT(again.updated_voxels, 0);
}

// Each frees what the other misses only near edges: the projective mode tests a voxel's centre,
// the exact mode frees whatever a ray grazes. Where a voxel is no larger than a pixel's footprint
// the ray through the centre's pixel crosses the voxel, so projective ⊂ exact.
TEST(Fusion, ProjectiveHitsAreTheExactOnesAndFreesNearlyAll) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const BallScene scene = BallScene::random(seed, 60);
    Rng rng(seed, "camera");
    const auto view =
        scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(320, 240, 1.396));
    VoxelMapOptions options;
    options.resolution_m = 0.02;
    VoxelMap projective(options), exact(options);
    const FuseResult a = fuse(projective, view.frame, view.roi);
    const FuseResult b = fuse_exact(exact, view.frame, view.roi);
    EXPECT_EQ(a.fused_points, b.fused_points);
    EXPECT_EQ(projective.occupied_voxels(), exact.occupied_voxels());
    EXPECT_EQ(projective.roi_voxels(), exact.roi_voxels());
    std::int64_t only_projective = 0;
    for (const BlockKey key : projective.block_keys()) {
      if (exact.block(key) == nullptr) {
        EXPECT_EQ(projective.block(key)->occupied.count(), 0);
        only_projective += projective.block(key)->observed.count();
        continue;
      }
      EXPECT_TRUE(projective.block(key)->occupied == exact.block(key)->occupied);
      EXPECT_TRUE(projective.block(key)->roi == exact.block(key)->roi);
      VoxelMask extra = projective.block(key)->observed;
      extra -= exact.block(key)->observed;
      only_projective += extra.count();
    }
    const auto share = [&](std::int64_t n) {
      return static_cast<double>(n) / static_cast<double>(exact.observed_voxels());
    };
    EXPECT_LT(share(only_projective), 0.002) << "seed " << seed;
    EXPECT_GT(share(projective.observed_voxels()), 0.92) << "seed " << seed;
    RecordProperty("observed_share_seed_" + std::to_string(seed),
                   std::to_string(share(projective.observed_voxels())) + " extra " +
                       std::to_string(share(only_projective)));
  }
}

TEST(Fusion, TheExactModeIsOctoMapVoxelByVoxel) {
  const BallScene scene = BallScene::random(3, 40);
  VoxelMapOptions options;
  options.resolution_m = 0.05;
  VoxelMap map(options);
  octomap::OcTree tree(0.05);
  Rng rng(3, "cameras");
  for (int i = 0; i < 3; ++i) {
    const auto view =
        scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(80, 60, 1.396));
    FusionOptions fusion;
    fusion.max_range_m = 1.1;  // some points are beyond
    fuse_exact(map, view.frame, view.roi, fusion);
    insert_frame(view.frame, 1.1, tree);
  }
  const auto [compared, different] = compare(map, tree);
  EXPECT_GT(compared, 5000);
  EXPECT_EQ(compared, map.observed_voxels());
  // OctoMap keeps points in single precision: a ray may graze one voxel more or less.
  EXPECT_LE(different, compared / 1000);
}

TEST(Fusion, OneThreadAndManyGiveTheSameMap) {
  const auto run = [](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return BallScene::map(5, 3);
  };
  const VoxelMap one = run(1);
  const VoxelMap four = run(4);
  EXPECT_EQ(one.block_keys(), four.block_keys());
  for (const BlockKey key : one.block_keys()) {
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      ASSERT_EQ(one.occupancy_log_odds(v), four.occupancy_log_odds(v));
      ASSERT_EQ(one.roi_log_odds(v), four.roi_log_odds(v));
    });
  }
}

}  // namespace
}  // namespace canopeer
