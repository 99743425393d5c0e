#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "ball_scene.h"
#include "canopeer/map/distances/distance_tile.h"
#include "canopeer/map/frontiers/frontier_masks.h"
#include "canopeer/map/fusion/frame_kernels.h"
#include "canopeer/map/storage/log_odds_kernels.h"
#include "canopeer/map/views/ray_kernels.h"
#include "canopeer/map/views/slice_kernels.h"
#include "canopeer/map/voxel_set.h"
#include "same_map.h"

namespace canopeer {
namespace {

// The levels beside the scalar one that this machine has.
std::vector<SimdLevel> vector_levels() {
  std::vector<SimdLevel> levels;
  for (const SimdLevel level : kSimdLevels) {
    if (level != SimdLevel::scalar && level <= best_simd_level()) levels.push_back(level);
  }
  return levels;
}

VoxelMask random_mask(Rng& rng, double share) {
  VoxelMask mask;
  for (std::uint64_t& slice : mask.slices) {
    if (rng.chance(0.2)) continue;
    for (int bit = 0; bit < 64; ++bit) slice |= std::uint64_t{rng.chance(share)} << bit;
  }
  return mask;
}

TEST(SimdKernels, RowsOfPixelsEndInTheSameVoxels) {
  Rng rng(1, "rows");
  const float strange[] = {0.0F,
                           -0.0F,
                           -1.0F,
                           std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::max(),
                           std::numeric_limits<float>::denorm_min()};
  for (int round = 0; round < 200; ++round) {
    const std::size_t width = 1 + rng.index(70);
    std::vector<float> depth(width);
    std::vector<double> x(width), y(width), z(width), across2(width);
    for (std::size_t u = 0; u < width; ++u) {
      depth[u] = rng.chance(0.2) ? strange[rng.index(8)] : static_cast<float>(rng.uniform(0, 4));
      x[u] = rng.uniform(-1, 1);
      y[u] = rng.uniform(-1, 1);
      z[u] = rng.uniform(-1, 1);
      across2[u] = rng.uniform(0, 1);
    }
    PixelRow row;
    row.width = width;
    row.depth = depth.data();
    row.across_x = x.data();
    row.across_y = y.data();
    row.across_z = z.data();
    row.across2 = across2.data();
    row.along = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    row.along2 = 1.0 + rng.uniform();
    row.origin = {rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
    row.max_range_m = 3.0;
    row.resolution_m = 0.01;
    row.clear_no_return = rng.chance(0.5);
    struct Ends {
      std::vector<float> free_depth;
      std::vector<std::int32_t> x, y, z, is_end;
    };
    const auto project = [&](SimdLevel level) {
      Ends ends{std::vector<float>(width), std::vector<std::int32_t>(width),
                std::vector<std::int32_t>(width), std::vector<std::int32_t>(width),
                std::vector<std::int32_t>(width)};
      frame_kernels(level).end_point_row(row, {ends.free_depth.data(), ends.x.data(), ends.y.data(),
                                               ends.z.data(), ends.is_end.data()});
      return ends;
    };
    const Ends scalar = project(SimdLevel::scalar);
    for (const SimdLevel level : vector_levels()) {
      const Ends vector = project(level);
      EXPECT_EQ(scalar.is_end, vector.is_end) << simd_level_name(level);
      EXPECT_EQ(scalar.x, vector.x) << simd_level_name(level);
      EXPECT_EQ(scalar.y, vector.y) << simd_level_name(level);
      EXPECT_EQ(scalar.z, vector.z) << simd_level_name(level);
      for (std::size_t u = 0; u < width; ++u) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(scalar.free_depth[u]),
                  std::bit_cast<std::uint32_t>(vector.free_depth[u]))
            << simd_level_name(level) << " depth " << depth[u];
      }
    }
  }
}

TEST(SimdKernels, PixelsThatSayWhatTheirNeighboursSaidAreToldFromTheFirst) {
  Rng rng(1, "first pixels");
  for (int round = 0; round < 300; ++round) {
    const std::size_t width = 1 + rng.index(150);
    struct Row {
      std::vector<std::int32_t> x, y, z, is_end, label;
      PixelRowEnds ends() { return {nullptr, x.data(), y.data(), z.data(), is_end.data()}; }
    };
    const auto random_row = [&] {
      Row row;
      for (auto* ints : {&row.x, &row.y, &row.z}) {
        for (std::size_t u = 0; u < width; ++u) ints->push_back(rng.chance(0.1) ? -1 : 0);
      }
      for (std::size_t u = 0; u < width; ++u) row.is_end.push_back(rng.chance(0.9));
      return row;
    };
    Row above = random_row();
    for (std::size_t u = 0; u < width; ++u) {
      above.label.push_back(above.is_end[u] * (1 + static_cast<int>(rng.index(3))));
    }
    Row row = random_row();
    row.label.resize(width);
    std::vector<std::uint8_t> mask(width);
    for (std::uint8_t& value : mask) value = static_cast<std::uint8_t>(rng.index(3));
    LabelledRow labelled;
    labelled.width = width;
    labelled.ends = row.ends();
    labelled.above = above.ends();
    labelled.mask = rng.chance(0.3) ? nullptr : mask.data();
    labelled.most = rng.chance(0.5) ? 1 : 255;
    labelled.label = row.label.data();
    labelled.label_above = above.label.data();

    const auto what = [](const Row& of, std::size_t u) {
      return std::array{of.label[u], of.x[u], of.y[u], of.z[u]};
    };
    for (const SimdLevel level : kSimdLevels) {
      if (level > best_simd_level()) continue;
      std::vector<std::uint64_t> first((width + 63) / 64, ~std::uint64_t{0});
      frame_kernels(level).first_pixels(labelled, first.data());
      for (std::size_t u = 0; u < width; ++u) {
        const int value = labelled.mask == nullptr ? 0 : std::min(mask[u], labelled.most);
        ASSERT_EQ(row.label[u], row.is_end[u] * (1 + value)) << simd_level_name(level);
        const bool said =
            what(row, u) == what(above, u) || (u > 0 && what(row, u) == what(row, u - 1));
        ASSERT_EQ((first[u / 64] >> u % 64 & 1) != 0, row.is_end[u] != 0 && !said)
            << simd_level_name(level) << " pixel " << u << " of " << width;
      }
      EXPECT_EQ(width % 64 == 0 ? 0 : first.back() >> width % 64, 0);
    }
  }
}

TEST(SimdKernels, LogOddsMoveByTheSameSteps) {
  Rng rng(2, "log-odds");
  LogOddsSteps steps;
  steps.hit = 1735;
  steps.miss = -830;
  steps.min = -4081;
  steps.max = 7119;
  for (int round = 0; round < 300; ++round) {
    steps.threshold = static_cast<std::int16_t>(rng.index(4000)) - 2000;
    std::array<std::int16_t, kBlockVoxels> start;
    for (std::int16_t& cell : start) {
      cell = static_cast<std::int16_t>(steps.min + static_cast<int>(rng.index(11201)));
    }
    if (round % 10 == 0) start.fill(steps.min);
    const VoxelMask hit = random_mask(rng, rng.uniform());
    VoxelMask miss = random_mask(rng, rng.uniform());
    miss -= hit;
    const VoxelMask above = random_mask(rng, 0.5);
    auto scalar_cells = start;
    VoxelMask scalar_above = above;
    log_odds_kernels(SimdLevel::scalar).step(scalar_cells.data(), hit, miss, steps, scalar_above);
    auto scalar_missed = start;
    const LogOddsRange range =
        log_odds_kernels(SimdLevel::scalar).miss_all(scalar_missed.data(), steps);
    EXPECT_EQ(range.min, *std::min_element(scalar_missed.begin(), scalar_missed.end()));
    EXPECT_EQ(range.max, *std::max_element(scalar_missed.begin(), scalar_missed.end()));
    for (const SimdLevel level : vector_levels()) {
      auto cells = start;
      VoxelMask now_above = above;
      log_odds_kernels(level).step(cells.data(), hit, miss, steps, now_above);
      EXPECT_EQ(cells, scalar_cells) << simd_level_name(level);
      EXPECT_EQ(now_above, scalar_above) << simd_level_name(level);
      auto missed = start;
      const LogOddsRange vector_range = log_odds_kernels(level).miss_all(missed.data(), steps);
      EXPECT_EQ(missed, scalar_missed) << simd_level_name(level);
      EXPECT_EQ(vector_range.min, range.min);
      EXPECT_EQ(vector_range.max, range.max);
    }
  }
}

// Depth pyramid, classification and voxel test, through what they are for.
TEST(SimdKernels, FramesAreFusedIntoTheSameMap) {
  for (const double resolution : {0.005, 0.02}) {
    VoxelMapOptions options;
    options.resolution_m = resolution;
    VoxelMap scalar(options);
    std::vector<VoxelMap> vector(vector_levels().size(), VoxelMap(options));
    const BallScene scene = BallScene::random(3, 60);
    Rng rng(3, "cameras");
    for (int frame = 0; frame < 3; ++frame) {
      const auto view =
          scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(161, 117, 1.396));
      FusionOptions fusion;
      fusion.max_range_m = frame == 2 ? 1.1 : 3.0;
      fusion.clear_no_return = frame == 2;
      fusion.simd = SimdLevel::scalar;
      const FuseResult expected = fuse(scalar, view.frame, view.roi, fusion);
      for (std::size_t i = 0; i < vector.size(); ++i) {
        fusion.simd = vector_levels()[i];
        const FuseResult result = fuse(vector[i], view.frame, view.roi, fusion);
        EXPECT_EQ(result.fused_points, expected.fused_points);
        EXPECT_EQ(result.updated_voxels, expected.updated_voxels);
        EXPECT_EQ(result.newly_known, expected.newly_known);
        EXPECT_EQ(result.changed, expected.changed);
      }
    }
    for (const VoxelMap& map : vector) expect_same_map(scalar, map);
  }
}

// The classification only saves work: all that is free in a cube it calls free, nothing in one it
// calls not free, as the voxel-by-voxel test sees it.
TEST(SimdKernels, CubesAreClassifiedAsTheirVoxelsAre) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const BallScene scene = BallScene::random(seed, 60);
    Rng rng(seed, "camera");
    const auto view =
        scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(160, 120, 1.396));
    VoxelMap map;
    fuse(map, view.frame, view.roi);
    const Pose T_camera_world = view.frame.T_world_camera.inverse();
    const CameraIntrinsics& k = view.frame.intrinsics;
    std::int64_t border = 0, compared = 0;
    for (int i = 0; i < 200000; ++i) {
      const Vec3 p{rng.uniform(-0.5, 1.5), rng.uniform(-1.5, 1.5), rng.uniform(-1.2, 1.2)};
      const VoxelIndex voxel = voxel_at(p, 0.01);
      if (map.occupancy(voxel) == Occupancy::occupied) continue;
      const Vec3 c = T_camera_world * voxel_centre(voxel, 0.01);
      const double u = k.fx * c.x() / c.z() + k.cx;
      const double v = k.fy * c.y() / c.z() + k.cy;
      bool free = false;
      if (c.z() > 0 && u >= 0 && u < k.width && v >= 0 && v < k.height) {
        const auto depth =
            static_cast<double>(view.frame.depth.at(static_cast<int>(u), static_cast<int>(v)));
        const double limit = 3.0 * c.z() / c.norm();
        free = c.z() < depth && c.z() < limit;
      }
      ++compared;
      border += free != (map.occupancy(voxel) == Occupancy::free);
    }
    // Rounding decides where a centre falls on the border of two pixels.
    EXPECT_LE(border, compared / 1000) << "seed " << seed;
  }
}

// Walks from lattice points too, where ties decide, and walks of one voxel.
TEST(SimdKernels, RaysCrossTheVoxelsAPlainWalkerCrosses) {
  constexpr std::size_t kVoxels = 120;
  Rng rng(6, "rays");
  const VoxelIndex corner = VoxelIndex::Constant(-160);
  for (int round = 0; round < 100; ++round) {
    const auto point = [&] {
      const auto place = [&] {
        const double p = rng.uniform(-0.3, 0.3);
        return round % 2 == 0 ? std::round(100.0 * p) / 100.0 : p;
      };
      return Vec3(place(), place(), place());
    };
    RayLanes lanes;
    std::vector<std::vector<VoxelIndex>> expected(RayLanes::kCount);
    for (std::size_t lane = 0; lane < RayLanes::kCount; ++lane) {
      const Vec3 from = point(), to = round % 10 == 0 ? from : point();
      lanes.set(lane, VoxelWalk(from, to, 0.01), corner);
      walk_voxels(from, to, 0.01, [&](const VoxelIndex& v) {
        expected[lane].push_back(v);
        return true;
      });
    }
    for (const SimdLevel level : kSimdLevels) {
      if (level > best_simd_level()) continue;
      std::vector<RayLanes::Row<PackedVoxel>> at(kVoxels);
      std::vector<RayLanes::Row<std::uint64_t>> run(kVoxels);
      std::vector<std::uint8_t> slice(kVoxels * RayLanes::kCount);
      std::vector<std::uint8_t> leaves_slice(kVoxels), leaves_block(kVoxels);
      walk_rays_kernel(level)(lanes, kVoxels,
                              {at.front().items.data(), slice.data(), run.front().items.data(),
                               leaves_slice.data(), leaves_block.data()});
      for (std::size_t lane = 0; lane < RayLanes::kCount; ++lane) {
        const std::vector<VoxelIndex>& walk = expected[lane];
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < std::min(kVoxels, walk.size()); ++i) {
          const VoxelIndex v = walk[i] - corner;
          ASSERT_EQ(at[i].items[lane],
                    v.x() + v.y() * packed_voxel::kOneOf[1] + v.z() * packed_voxel::kOneOf[2])
              << simd_level_name(level);
          ASSERT_EQ(slice[i * RayLanes::kCount + lane], VoxelMask::slice_of(walk[i]));
          bits |= VoxelMask::bit_of(walk[i]);
          ASSERT_EQ(run[i].items[lane], bits) << simd_level_name(level);
          if (i + 1 == walk.size()) break;
          const bool other_block = block_key(walk[i + 1]) != block_key(walk[i]);
          const bool other_slice = other_block || walk[i + 1].z() != walk[i].z();
          ASSERT_EQ((leaves_block[i] >> lane & 1) != 0, other_block) << simd_level_name(level);
          ASSERT_EQ((leaves_slice[i] >> lane & 1) != 0, other_slice) << simd_level_name(level);
          if (other_slice) bits = 0;
        }
      }
    }
  }
}

// From lattice points too, where rounding at the end has to be mended.
TEST(SimdKernels, RaysStartAsPlainWalksDo) {
  Rng rng(8, "starts");
  const VoxelIndex corner = VoxelIndex::Constant(-400);
  for (int round = 0; round < 400; ++round) {
    const auto point = [&](double far) {
      const auto place = [&] {
        const double p = rng.uniform(-far, far);
        return round % 2 == 0 ? std::round(100.0 * p) / 100.0 : p;
      };
      return Vec3(place(), place(), place());
    };
    const Vec3 from = point(0.3);
    std::vector<Vec3> ends(1 + rng.index(RayLanes::kCount));
    for (Vec3& end : ends) end = rng.chance(0.05) ? from : point(rng.chance(0.2) ? 0.02 : 3.0);
    if (round % 3 == 0) ends.front().x() = from.x();
    for (const SimdLevel level : kSimdLevels) {
      if (level > best_simd_level()) continue;
      RayLanes rays, expected;
      start_rays_kernel(level)(from, ends, 0.01, corner, rays);
      for (std::size_t lane = 0; lane < RayLanes::kCount; ++lane) {
        const VoxelWalk walk(from, ends[std::min(lane, ends.size() - 1)], 0.01);
        expected.set(lane, walk, corner);
        ASSERT_EQ(rays.at[lane], expected.at[lane]) << simd_level_name(level);
        ASSERT_EQ(rays.steps[lane], walk.steps) << simd_level_name(level);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          ASSERT_EQ(rays.t[axis][lane], walk.t_next[axis]) << simd_level_name(level);
          ASSERT_EQ(rays.dt[axis][lane], walk.t_delta[axis]) << simd_level_name(level);
          if (walk.t_delta[axis] == 0) continue;  // never moves so
          ASSERT_EQ(rays.move[axis][lane], expected.move[axis][lane]) << simd_level_name(level);
        }
      }
    }
  }
}

TEST(SimdKernels, WhatIsCrossedAndUnknownIsCollectedSliceBySlice) {
  Rng rng(9, "slices");
  constexpr std::size_t kBlocks = 50;
  std::vector<MetBlock> blocks(kBlocks);
  std::vector<VoxelMask> observed(kBlocks);
  const BlockKey first = pack_block(-3, 5, -70);
  std::vector<std::uint32_t> numbers;
  std::vector<VoxelSet::Block> expected;
  for (std::uint32_t i = 0; i < kBlocks; ++i) {
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      blocks[i].crossed.slices[z] = rng.chance(0.6) ? 0 : rng.bits();
      observed[i].slices[z] = rng.chance(0.3) ? ~std::uint64_t{0} : rng.bits();
    }
    if (rng.chance(0.2)) blocks[i].crossed = {};
    blocks[i].observed = &observed[i];
    blocks[i].place = i;
    if (rng.chance(0.2)) continue;
    numbers.push_back(i);
    expected.push_back({first + i, blocks[i].crossed});
    expected.back().mask -= observed[i];
  }
  for (const SimdLevel level : kSimdLevels) {
    if (level > best_simd_level()) continue;
    std::vector<BlockKey> keys(kBlocks + 1);
    std::vector<std::uint32_t> places(kBlockSide * (kBlocks + 1));
    std::vector<std::uint64_t> words(kBlockSide * (kBlocks + 1));
    const SliceCount count = collect_unknown_kernel(level)(
        numbers, blocks.data(), first, {keys.data(), places.data(), words.data()});
    EXPECT_EQ(VoxelSet({keys.data(), count.blocks}, {places.data(), count.words},
                       {words.data(), count.words}),
              VoxelSet(expected))
        << simd_level_name(level);
  }
}

TEST(SimdKernels, BitsPerStepAreTurnedIntoARowALane) {
  Rng rng(7, "rows");
  for (const std::size_t steps : {1U, 8U, 63U, 64U, 65U, 200U}) {
    std::vector<std::uint8_t> lanes((steps + 7) / 8 * 8);
    for (std::uint8_t& step : lanes) step = static_cast<std::uint8_t>(rng.uniform(0, 256));
    std::vector<std::uint64_t> rows(RayLanes::kCount * (steps / 64 + 1));
    const std::size_t words = turn_to_rows(lanes.data(), steps, rows.data());
    for (std::size_t lane = 0; lane < RayLanes::kCount; ++lane) {
      for (std::size_t step = 0; step < steps; ++step) {
        ASSERT_EQ(rows[lane * words + step / 64] >> (step % 64) & 1, lanes[step] >> lane & 1U)
            << steps << " steps, lane " << lane << ", step " << step;
      }
    }
  }
}

TEST(SimdKernels, DistanceTilesAreTheSame) {
  Rng rng(5, "tiles");
  // Reach 15 has loops of its own.
  for (const int reach : {7, 14, 15, 28}) {
    const int halo = (reach + kBlockSide - 1) / kBlockSide;
    const auto side = static_cast<std::size_t>(kTileBlocks + 2 * halo);
    for (int round = 0; round < 6; ++round) {
      std::vector<VoxelMask> blocks(side * side * side);
      for (VoxelMask& mask : blocks) {
        if (rng.chance(0.02 * round)) mask = random_mask(rng, 0.05);
      }
      const TileSurroundings around{blocks.data(), side, side * side, halo};
      TileScratch scratch;
      std::vector<std::uint8_t> scalar, wide;
      tile_distance2(around, reach, scratch, scalar, SimdLevel::scalar);
      for (const SimdLevel level : vector_levels()) {
        tile_distance2(around, reach, scratch, wide, level);
        EXPECT_EQ(wide, scalar);
      }
    }
  }
}

TEST(SimdKernels, FrontiersAreTheSame) {
  const VoxelMap map = BallScene::map(4, 2);
  for (const BlockKey key : map.block_keys()) {
    const FrontierMasks scalar = frontier_masks(map, key, true, SimdLevel::scalar);
    for (const SimdLevel level : vector_levels()) {
      EXPECT_EQ(frontier_masks(map, key, true, level), scalar);
    }
  }
}

}  // namespace
}  // namespace canopeer
