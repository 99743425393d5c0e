#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "canopeer/base/simd_level.h"
#include "canopeer/map/storage/block.h"

namespace canopeer {

inline constexpr int kTileBlocks = 4;
inline constexpr int kTileSide = kTileBlocks * kBlockSide;

/// Occupied masks of (4 + 2 · halo)³ blocks, the tile in the middle. Block (x, y, z) is first[x + y
/// · stride_y + z · stride_z].
struct TileSurroundings {
  const VoxelMask* first = nullptr;
  std::size_t stride_y = 0;
  std::size_t stride_z = 0;
  int halo = 0;
};

/// Memory a thread uses again from tile to tile.
struct TileScratch {
  struct alignas(64) Line {
    std::array<std::uint8_t, 64> bytes;
  };
  std::vector<Line> lines;
};

/// Squares up to 15² fit a byte; others take two (native order).
inline int tile_cell_bytes(int reach) { return reach <= 15 ? 1 : 2; }

/// Per voxel of the tile (x fastest): min(reach², squared gap to the nearest occupied voxel). The
/// gap of voxels n apart on an axis is max(0, n − 1): what is certain for any two of their points.
/// Empty when nothing is within reach. reach ≤ 8 · halo and ≤ 120. `out`: tile_cell_bytes() a
/// voxel; its memory is used again. `simd` must be a level the machine has; it changes the speed
/// only.
void tile_distance2(const TileSurroundings& around, int reach, TileScratch& scratch,
                    std::vector<std::uint8_t>& out, SimdLevel simd = best_simd_level());

}  // namespace canopeer
