#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/base/simd_level.h"
#include "canopeer/map/block.h"

namespace canopeer {

inline constexpr int kTileBlocks = 4;
inline constexpr int kTileSide = kTileBlocks * kBlockSide;

/// Occupied masks of (4 + 2 · halo)³ blocks, the tile in the middle: block (x, y, z) is
/// first[x + y · stride_y + z · stride_z].
struct TileSurroundings {
  const VoxelMask* first = nullptr;
  std::size_t stride_y = 0;
  std::size_t stride_z = 0;
  int halo = 0;
};

/// Memory a thread uses again from tile to tile.
struct TileScratch {
  std::vector<std::int16_t> x_pass;
  std::vector<std::int16_t> xy_pass;
  std::vector<std::uint8_t> x_row_used;
  std::vector<std::uint8_t> xy_row_used;
};

/// Per voxel of the tile (x fastest) min(reach², squared gap to the nearest occupied voxel), the
/// gap of voxels n apart on an axis being max(0, n − 1): what is certain for any two of their
/// points. Empty when nothing is within reach. reach ≤ 8 · halo and ≤ 120.
/// `simd` must be a level the machine has; it changes the speed only.
std::vector<std::int16_t> tile_distance2(const TileSurroundings& around, int reach,
                                         TileScratch& scratch, SimdLevel simd = best_simd_level());

}  // namespace canopeer
