#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "canopeer/base/simd_level.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// A block that rays come to.
struct alignas(64) MetBlock {
  VoxelMask crossed;          ///< by rays, before an occupied voxel
  const VoxelMask* observed;  ///< all of a clear block: nothing is new or in the way there
  const VoxelMask* occupied;
  const BlockMasks* known;  ///< nullptr: nothing observed there
  BlockKey place;           ///< in the window of blocks: the fields of a key, without its offsets
  std::uint32_t cell;       ///< of the window
};

/// Room for a voxel set (VoxelSet::keys() and so on): as many keys as there may be blocks, for each
/// of them eight places and words.
struct SliceRoom {
  BlockKey* keys;
  std::uint32_t* places;
  std::uint64_t* words;
};

struct SliceCount {
  std::size_t blocks = 0, words = 0;
};

/// What is crossed and not observed of the blocks `numbers`, in their order. `first`: the key of
/// the window's first block. Writes up to eight items behind the last one it counts.
using CollectUnknown = SliceCount (*)(std::span<const std::uint32_t> numbers,
                                      const MetBlock* blocks, BlockKey first, const SliceRoom& out);

/// `level` must be one the machine has.
CollectUnknown collect_unknown_kernel(SimdLevel level);

}  // namespace canopeer
