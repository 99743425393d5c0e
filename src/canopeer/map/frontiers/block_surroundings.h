#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// For some blocks: what the block itself or one of the 26 around it holds, from
/// the blocks' summaries alone. Tells where a frontier can be before any voxel is looked at.
class BlockSurroundings {
 public:
  /// `keys`: at least one; memory grows with the box around them.
  BlockSurroundings(const VoxelMap& map, const std::vector<BlockKey>& keys);

  /// Some voxel in the 3 × 3 × 3 blocks around `key` is unknown. `key` is one of
  /// those given.
  [[nodiscard]] bool has_unknown(BlockKey key) const { return (flags_[cell(key)] & kUnknown) != 0; }
  /// Some voxel there is ROI.
  [[nodiscard]] bool has_roi(BlockKey key) const { return (flags_[cell(key)] & kRoi) != 0; }

 private:
  static constexpr std::uint8_t kUnknown = 1;
  static constexpr std::uint8_t kRoi = 2;

  [[nodiscard]] std::size_t cell(BlockKey key) const;

  VoxelIndex first_;  // block; two beside those given
  VoxelIndex size_;   // blocks
  std::vector<std::uint8_t> flags_;
};

/// Flags of a grid of blocks: gives each what its two neighbours at this stride hold. The outermost
/// hold anything afterwards.
void spread_flags(std::size_t stride, std::vector<std::uint8_t>& flags);

}  // namespace canopeer
