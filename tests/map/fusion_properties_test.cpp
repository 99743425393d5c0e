// Laws of fusing frames, on seeded random scenes.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "ball_scene.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/map/voxel_union.h"
#include "octomap_oracle.h"
#include "same_map.h"

namespace canopeer {
namespace {

BallScene::View random_view(std::uint64_t seed, int width = 120, int height = 90) {
  const BallScene scene = BallScene::random(seed, 50);
  Rng rng(seed, "camera");
  return scene.render(BallScene::random_camera(rng),
                      CameraIntrinsics::from_fov(width, height, 1.396));
}

VoxelMapOptions coarse() {
  VoxelMapOptions options;
  options.resolution_m = 0.02;
  return options;
}

// Two cameras back to back at x = −0.3 and x = 0.3: no voxel is seen by both.
TEST(FusionLaws, FramesOfDisjointViewsCommute) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng(seed, "depths");
    const auto frame = [&](double side) {
      RgbdFrame f;
      f.intrinsics = CameraIntrinsics::from_fov(80, 60, 1.2);
      const Vec3 from{0.3 * side, rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)};
      f.T_world_camera = look_at(from, from + Vec3(side, 0, 0));
      f.depth = DepthImage(80, 60);
      for (float& d : f.depth.pixels()) d = static_cast<float>(rng.uniform(0.1, 1.5));
      return f;
    };
    const RgbdFrame left = frame(-1.0);
    const RgbdFrame right = frame(1.0);
    for (const auto mode : {&fuse, &fuse_exact}) {
      VoxelMap one(coarse()), other(coarse());
      mode(one, left, Mask(80, 60, 1), {});
      mode(one, right, {}, {});
      mode(other, right, {}, {});
      mode(other, left, Mask(80, 60, 1), {});
      expect_same_map(one, other);
    }
  }
}

TEST(FusionLaws, AVoxelHitIsNeverFreeInTheSameFrame) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto view = random_view(seed);
    for (const auto mode : {&fuse, &fuse_exact}) {
      VoxelMap map(coarse());
      mode(map, view.frame, view.roi, {});
      const CameraIntrinsics& k = view.frame.intrinsics;
      for (int v = 0; v < k.height; ++v) {
        for (int u = 0; u < k.width; ++u) {
          const double depth = static_cast<double>(view.frame.depth.at(u, v));
          if (!std::isfinite(depth) || depth * k.ray(u, v).norm() > 2.99) continue;
          const Vec3 p = view.frame.T_world_camera * (depth * k.ray(u, v));
          const VoxelIndex voxel = voxel_at(p, map.resolution_m());
          // Rounding may put a point on the border into the voxel beside it.
          const Vec3 inside = p / map.resolution_m() - voxel.cast<double>();
          if (inside.minCoeff() < 1e-6 || inside.maxCoeff() > 1.0 - 1e-6) continue;
          ASSERT_EQ(map.occupancy(voxel), Occupancy::occupied) << "seed " << seed;
        }
      }
    }
  }
}

// Moving camera and scene by whole blocks moves the map; with steps that are not whole chunks the
// frame meets all kinds of block and chunk borders, on both sides of zero.
TEST(FusionLaws, AFrameMovedByBlocksGivesTheMapMovedByBlocks) {
  const auto view = random_view(2);
  VoxelMapOptions options;
  options.resolution_m = 1.0 / 64.0;  // exact in binary, so that moving rounds nothing
  VoxelMap at_home(options);
  RgbdFrame frame = view.frame;
  // A pose that is exact in single precision and stays so when it is moved.
  frame.T_world_camera = Pose::Identity();
  frame.T_world_camera.translation() = Vec3(0.125 + 1.0 / 256, 0.25 + 1.0 / 256, 1.0 / 256);
  fuse(at_home, frame, view.roi);
  for (const VoxelIndex& blocks : {VoxelIndex(-1, 0, 0), VoxelIndex(-7, -13, -22),
                                   VoxelIndex(3, -2, 1), VoxelIndex(-64, 64, -8)}) {
    RgbdFrame moved = frame;
    moved.T_world_camera.translation() += blocks.cast<double>() * kBlockSide / 64.0;
    VoxelMap away(options);
    fuse(away, moved, view.roi);
    EXPECT_EQ(away.observed_voxels(), at_home.observed_voxels());
    std::int64_t different = 0;
    for (const BlockKey key : at_home.block_keys()) {
      for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
        const VoxelIndex there = v + blocks * kBlockSide;
        different += at_home.occupancy_log_odds(v) != away.occupancy_log_odds(there) ||
                     at_home.roi_log_odds(v) != away.roi_log_odds(there);
      });
    }
    EXPECT_EQ(different, 0) << blocks.transpose();
  }
}

TEST(FusionLaws, AMaskedPixelSaysNothingEvenWhereNoReturnMeansFree) {
  RgbdFrame frame;
  frame.intrinsics = CameraIntrinsics::from_fov(80, 60, 1.2);
  frame.T_world_camera = look_at(Vec3(0.003, 0.004, 0.002), Vec3(1.0, 0.004, 0.002));
  frame.depth = DepthImage(80, 60, -1.0F);
  FusionOptions options;
  options.clear_no_return = true;
  VoxelMap map;
  EXPECT_EQ(fuse(map, frame, {}, options).fused_points, 0);
  EXPECT_EQ(map.observed_voxels(), 0);
}

TEST(FusionLaws, ConfidencesOfNoAndYesAreAMask) {
  const auto view = random_view(4);
  Mask sure = view.roi;
  for (std::uint8_t& pixel : sure.pixels()) pixel = pixel != 0 ? 255 : 0;
  FusionOptions graded;
  graded.roi_is_confidence = true;
  for (const auto mode : {&fuse, &fuse_exact}) {
    VoxelMap by_mask(coarse()), by_confidence(coarse());
    for (int i = 0; i < 3; ++i) {
      mode(by_mask, view.frame, view.roi, {});
      mode(by_confidence, view.frame, sure, graded);
    }
    EXPECT_GT(by_mask.roi_voxels(), 0);
    expect_same_map(by_mask, by_confidence);
  }
}

TEST(FusionLaws, RoiRisesWithTheConfidenceOfTheSurestPixel) {
  RgbdFrame frame;
  frame.intrinsics = CameraIntrinsics::from_fov(160, 120, 1.396);
  frame.T_world_camera = look_at(Vec3(0.003, 0.004, 0.002), Vec3(1.0, 0.004, 0.002));
  frame.depth = DepthImage(160, 120, 0.512F);
  FusionOptions options;
  options.roi_is_confidence = true;
  const VoxelIndex voxel =
      voxel_at(frame.T_world_camera * (0.512 * frame.intrinsics.ray(80, 60)), 0.01);
  double last = -10.0;
  for (int confidence = 0; confidence < 256; confidence += 15) {
    Mask roi(160, 120);
    roi.at(80, 60) = static_cast<std::uint8_t>(confidence);
    VoxelMap map;
    fuse(map, frame, roi, options);
    const double p = 0.4 + 0.3 * confidence / 255.0;
    EXPECT_NEAR(map.roi_log_odds(voxel), std::log(p / (1.0 - p)), 2.5e-4);
    EXPECT_GT(map.roi_log_odds(voxel), last);
    last = map.roi_log_odds(voxel);
  }
}

// Random scenes, several frames each; OctoMap keeps points in single precision, so a ray may graze
// one voxel more or less.
TEST(FusionLaws, TheExactModeIsOctoMapOnRandomScenes) {
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    VoxelMapOptions options;
    options.resolution_m = 0.05;
    VoxelMap map(options);
    octomap::OcTree tree(0.05);
    for (std::uint64_t i = 0; i < 2; ++i) {
      const auto view = random_view(100 * seed + i, 64, 48);
      FusionOptions fusion;
      fusion.max_range_m = 1.3;
      fuse_exact(map, view.frame, view.roi, fusion);
      insert_frame(view.frame, 1.3, tree);
    }
    const auto [compared, different] = compare(map, tree);
    EXPECT_GT(compared, 1000);
    EXPECT_NEAR(static_cast<double>(map.observed_voxels()), static_cast<double>(compared),
                0.001 * static_cast<double>(compared));
    EXPECT_LE(different, compared / 1000) << "seed " << seed;
  }
}

VoxelSet random_set(Rng& rng) {
  std::vector<VoxelSet::Block> blocks;
  for (int i = 0; i < 64; ++i) {
    if (rng.chance(0.5)) continue;
    VoxelSet::Block block{pack_block(i % 4 - 2, i / 4 % 4 - 2, i / 16 - 2), {}};
    for (std::uint64_t& slice : block.mask.slices) slice = rng.bits() & rng.bits();
    blocks.push_back(block);
  }
  return VoxelSet(std::move(blocks));
}

// Blocks that share their places in the table, and more than it has room for at first.
TEST(VoxelSetLaws, AUnionOfManyIsWhatMergingThemGives) {
  Rng rng(13, "unions");
  VoxelUnion together;
  for (int round = 0; round < 4; ++round) {
    VoxelSet merged;
    together.clear();
    EXPECT_EQ(together.count(), 0);
    const int far = round == 2 ? 100 : 2;
    for (int i = 0; i < 12; ++i) {
      std::map<BlockKey, VoxelSet::Block> blocks;
      for (int b = 0; b < (round == 2 ? 4000 : 60); ++b) {
        const auto index = [&](int step) {
          return step * static_cast<int>(std::floor(rng.uniform(-far, far)));
        };
        const BlockKey key = pack_block(index(round == 1 ? 64 : 1), index(1), index(32));
        VoxelSet::Block& block = blocks[key];
        block.key = key;
        block.mask.slices[0] |= std::uint64_t{1} << b % 64;
      }
      std::vector<VoxelSet::Block> list;
      for (const auto& [key, block] : blocks) list.push_back(block);
      const VoxelSet set(std::move(list));
      EXPECT_EQ(together.count_new(set), merged.count_new(set));
      merged.merge(set);
      together.add(set);
      EXPECT_EQ(together.count_new(set), 0);
      EXPECT_EQ(together.count(), merged.count());
    }
    EXPECT_EQ(together.set(), merged);
  }
}

TEST(VoxelSetLaws, UnionLosesNothingAndDifferenceIsWhatIsNotInTheOther) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng(seed, "sets");
    const VoxelSet a = random_set(rng), b = random_set(rng);
    VoxelSet both = a;
    both.merge(b);
    VoxelSet only_a = a;
    only_a.subtract(b);
    std::int64_t shared = 0;
    a.for_each([&](const VoxelIndex& v) {
      ASSERT_TRUE(both.contains(v));
      ASSERT_EQ(only_a.contains(v), !b.contains(v));
      shared += b.contains(v);
    });
    b.for_each([&](const VoxelIndex& v) { ASSERT_TRUE(both.contains(v)); });
    EXPECT_EQ(both.count(), a.count() + b.count() - shared);
    EXPECT_EQ(only_a.count(), a.count() - shared);
    EXPECT_EQ(b.count_new(a), only_a.count());
    VoxelSet again = only_a;
    again.merge(b);
    EXPECT_EQ(again, both);
    VoxelSet none = a;
    none.subtract(a);
    EXPECT_TRUE(none.empty());
    double sum = 0.0;
    const auto weight = [](const VoxelIndex& v) { return 1.0 / (1.0 + v.cwiseAbs().sum()); };
    a.for_each([&](const VoxelIndex& v) { sum += weight(v); });
    EXPECT_EQ(a.weighted_count(weight), sum);
    EXPECT_EQ(a.weighted_count([](const VoxelIndex&) { return 1.0; }),
              static_cast<double>(a.count()));
  }
}

TEST(ViewCastAll, SeesEveryVoxelOfItsRaysByKind) {
  const VoxelMap map = BallScene::map(2, 2);
  Rng rng(2, "views");
  std::int64_t roi = 0;
  for (int i = 0; i < 12; ++i) {
    const Pose T_world_camera = BallScene::random_camera(rng);
    ViewFan fan;
    fan.columns = 21;
    fan.rows = 17;
    fan.depth_m = 1.3;
    std::vector<VoxelIndex> unknown, free, occupied, fruit;
    for (int row = 0; row < fan.rows; ++row) {
      for (int column = 0; column < fan.columns; ++column) {
        const Vec3 end(std::tan(fan.fov_x_rad / 2) * (2.0 * column / (fan.columns - 1) - 1.0),
                       std::tan(fan.fov_y_rad / 2) * (2.0 * row / (fan.rows - 1) - 1.0), 1.0);
        walk_voxels(T_world_camera.translation(), T_world_camera * (fan.depth_m * end),
                    map.resolution_m(), [&](const VoxelIndex& v) {
                      const Occupancy state = map.occupancy(v);
                      (state == Occupancy::unknown ? unknown
                       : state == Occupancy::free  ? free
                                                   : occupied)
                          .push_back(v);
                      if (map.is_roi(v)) fruit.push_back(v);
                      return state != Occupancy::occupied;
                    });
      }
    }
    const auto set_of = [](const std::vector<VoxelIndex>& voxels) {
      VoxelSet set;
      for (const VoxelIndex& v : voxels) {
        VoxelSet::Block block{block_key(v), {}};
        block.mask.set(v);
        set.merge(VoxelSet({block}));
      }
      return set;
    };
    const SeenVoxels seen = cast_view_all(map, T_world_camera, fan);
    EXPECT_EQ(seen.occupied, set_of(occupied)) << "view " << i;
    EXPECT_EQ(seen.roi, set_of(fruit)) << "view " << i;
    const auto same = [&](const VoxelSet& set, const std::vector<VoxelIndex>& voxels) {
      VoxelMap counted;  // a quick set: the lists are long
      for (const VoxelIndex& v : voxels) {
        ASSERT_TRUE(set.contains(v));
        counted.set_occupancy_log_odds(v, 1.0);
      }
      EXPECT_EQ(counted.observed_voxels(), set.count());
    };
    same(seen.free, free);
    same(seen.unknown, unknown);
    const ViewCast cast = cast_view(map, T_world_camera, fan);
    EXPECT_EQ(seen.unknown, cast.unknown);
    EXPECT_EQ(seen.touched, cast.touched);
    roi += seen.roi.count();
  }
  EXPECT_GT(roi, 0);
}

TEST(ViewCastAll, ACastIsValidUntilABlockItTouchedChanges) {
  VoxelMap map = BallScene::map(2, 2);
  Rng rng(5, "views");
  const ViewCast cast = cast_view(map, BallScene::random_camera(rng));
  const std::uint64_t version = map.version();
  EXPECT_TRUE(still_valid(cast, map, version));
  const std::vector<BlockKey> touched = cast.touched.keys();
  const VoxelIndex inside = block_origin(touched[touched.size() / 2]);
  map.set_occupancy_log_odds(VoxelIndex(5000, 0, 0), 1.0);  // far away
  EXPECT_TRUE(still_valid(cast, map, version));
  map.set_occupancy_log_odds(inside, 1.0);
  EXPECT_FALSE(still_valid(cast, map, version));
  EXPECT_TRUE(still_valid(cast, map, map.version()));
}

}  // namespace
}  // namespace canopeer
