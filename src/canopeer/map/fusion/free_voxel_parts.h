#pragma once

#include <array>
#include <cstring>

#include "canopeer/map/fusion/frame_kernels.h"
#include "canopeer/map/storage/kernel_targets.h"

// Loads one by one: no compiler makes gathers or piecemeal vectors of them.
#if defined(__GNUC__) && !defined(__clang__)
#define CANOPEER_ONE_BY_ONE \
  [[gnu::noinline, gnu::optimize("no-tree-vectorize", "no-tree-slp-vectorize")]]
#else
#define CANOPEER_ONE_BY_ONE [[gnu::noinline]]
#endif

namespace canopeer {

// What the depth tests of single voxels have in common, whatever the instruction set.

constexpr int kHalf = kBlockSide / 2;
constexpr std::size_t kHalfVoxels = 64;

// The first centres of the block's half slices in the camera frame: x and y half; axis; slice.
using FirstCentres = float[4][3][kBlockSide];

CANOPEER_KERNEL_BODY void find_first_centres(const BlockProjection& projection,
                                             const std::array<int, 3>& corner,
                                             FirstCentres& first) {
  using Slices = double __attribute__((vector_size(sizeof(double) * kBlockSide)));
  using FloatSlices = float __attribute__((vector_size(sizeof(float) * kBlockSide)));
  const auto centre = [&](std::size_t axis, int steps) {
    return (corner[axis] + steps + 0.5) * projection.resolution_m;
  };
  Slices z = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5};
  z = (z + static_cast<double>(corner[2])) * projection.resolution_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& row = projection.rows[axis];
    const Slices up = row[2] * z;
    for (int column = 0; column < 4; ++column) {
      const double x = centre(0, (column & 1) * kHalf);
      const double y = centre(1, (column >> 1) * kHalf);
      const double across = row[0] * x + row[1] * y;
      const auto at = __builtin_convertvector(across + up + row[3], FloatSlices);
      std::memcpy(first[column][axis], &at, sizeof at);
    }
  }
}

#if defined(__x86_64__)
CANOPEER_TARGET_AVX512 VoxelMask free_in_block_avx512(const FlatPyramid& camera,
                                                      const BlockProjection& projection,
                                                      const std::array<int, 3>& corner,
                                                      const HalfBlocks& halves);
#endif

}  // namespace canopeer
