#include "canopeer/map/fusion/crossed_space.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "ball_scene.h"
#include "canopeer/map/fusion/end_points.h"

namespace canopeer {
namespace {

using Blocks = std::map<BlockKey, VoxelMask>;

// The definition: every ray is walked.
Blocks walk_every_ray(const RgbdFrame& frame, const DepthImage& free_depth, double resolution_m) {
  Blocks blocks;
  VoxelMask* mask = nullptr;
  BlockKey key = 0;
  const Vec3 origin = frame.T_world_camera.translation();
  for (int v = 0; v < free_depth.height(); ++v) {
    for (int u = 0; u < free_depth.width(); ++u) {
      const double depth = static_cast<double>(free_depth.at(u, v));
      if (depth <= 0.0) continue;
      const Vec3 end = frame.T_world_camera * (depth * frame.intrinsics.ray(u, v));
      const VoxelIndex last = voxel_at(end, resolution_m);
      walk_voxels(origin, end, resolution_m, [&](const VoxelIndex& voxel) {
        if (voxel == last) return false;
        if (mask == nullptr || block_key(voxel) != key) {
          key = block_key(voxel);
          mask = &blocks[key];
        }
        mask->set(voxel);
        return true;
      });
    }
  }
  return blocks;
}

Blocks as_blocks(const FreeSpace& free) {
  Blocks blocks;
  for (const BlockKey key : free.whole) {
    EXPECT_TRUE(blocks.emplace(key, VoxelMask::all()).second);
  }
  for (const FreeBlock& part : free.parts) {
    EXPECT_TRUE(blocks.emplace(part.key, part.free).second);
    EXPECT_TRUE(part.free.any());
    EXPECT_FALSE(part.free.full());
  }
  return blocks;
}

struct Case {
  double resolution_m;
  double fov_x_rad;
  int balls;
  FusionOptions fusion;
};

void expect_same(std::uint64_t seed, const Case& c, double holes) {
  const BallScene scene = BallScene::random(seed, c.balls);
  Rng rng(seed, "crossed space");
  auto view = scene.render(BallScene::random_camera(rng),
                           CameraIntrinsics::from_fov(160, 120, c.fov_x_rad));
  for (float& depth : view.frame.depth.pixels()) {
    if (rng.chance(holes)) depth = rng.chance(0.5) ? 0.0F : -1.0F;
  }
  for (const SimdLevel level : kSimdLevels) {
    if (level > best_simd_level()) continue;
    const FrameKernels& kernels = frame_kernels(level);
    EndPoints ends;
    find_end_points(view.frame, view.roi, c.fusion, c.resolution_m, kernels, ends);
    const Blocks walked = walk_every_ray(view.frame, ends.free_depth, c.resolution_m);
    FreeSpace found;
    find_crossed_space(view.frame, ends.free_depth, c.resolution_m, kernels, found);
    EXPECT_TRUE(walked == as_blocks(found))
        << "seed " << seed << ", voxels of " << c.resolution_m << " m, " << simd_level_name(level);
  }
}

TEST(CrossedSpace, IsWhatWalkingEveryRayFinds) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const double resolution : {0.01, 0.02, 0.037, 0.08}) {
      expect_same(seed, {resolution, 1.396, seed % 2 == 0 ? 200 : 12, {}}, 0.0);
    }
  }
}

TEST(CrossedSpace, IsSoWithHolesInTheImageAndRaysThatEndInTheAir) {
  FusionOptions fusion;
  fusion.clear_no_return = true;
  for (std::uint64_t seed = 20; seed <= 23; ++seed) {
    fusion.max_range_m = seed % 2 == 0 ? 0.9 : 3.0;
    expect_same(seed, {0.02, 1.0, 60, fusion}, 0.02);
    expect_same(seed, {0.03, 2.4, 60, fusion}, 0.0);
  }
}

// The centres of voxels at the edges of pixels, and rays along faces and edges of voxels.
TEST(CrossedSpace, IsSoWhenEverythingLiesOnLattices) {
  for (const double depth : {0.35, 0.8, 1.2}) {
    for (const double resolution : {0.01, 0.02, 0.05}) {
      RgbdFrame frame;
      frame.intrinsics = CameraIntrinsics::from_fov(64, 48, std::numbers::pi / 2.0);
      frame.depth = DepthImage(64, 48, static_cast<float>(depth));
      for (int u = 20; u < 30; ++u) frame.depth.at(u, 24) = 0.2F;
      const FrameKernels& kernels = frame_kernels(best_simd_level());
      EndPoints ends;
      find_end_points(frame, {}, {}, resolution, kernels, ends);
      FreeSpace found;
      find_crossed_space(frame, ends.free_depth, resolution, kernels, found);
      EXPECT_TRUE(walk_every_ray(frame, ends.free_depth, resolution) == as_blocks(found))
          << depth << " m, voxels of " << resolution << " m";
    }
  }
}

}  // namespace
}  // namespace canopeer
