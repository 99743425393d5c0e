#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_set.h"

namespace canopeer {

/// The union of many voxel sets, one after the other: blocks are found by a table that follows from
/// their indices, so adding a set costs what it holds, however much is there already. Its memory is
/// used again after clear().
class VoxelUnion {
 public:
  void clear();
  void add(const VoxelSet& set);
  [[nodiscard]] std::int64_t count() const;
  [[nodiscard]] VoxelSet set() const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct alignas(64) Mask : VoxelMask {};

  /// Neighbours lie side by side: no two blocks of a cube of 2^bits_ blocks a side share a place.
  [[nodiscard]] std::size_t home(BlockKey key) const {
    const BlockKey low = (BlockKey{1} << bits_) - 1;
    return static_cast<std::size_t>((key & low) | (key >> 21 & low) << bits_ |
                                    (key >> 42 & low) << 2 * bits_);
  }
  /// The number of a block whose place is taken by another; a new one when it is not there.
  std::uint32_t find_beside(BlockKey key);
  void grow();

  int bits_ = 5;
  std::vector<std::uint32_t> numbers_ = std::vector<std::uint32_t>(std::size_t{1} << 15, kNone);
  std::uint32_t count_ = 0;  // of blocks
  std::vector<BlockKey> keys_;
  std::vector<Mask> masks_;  // empty from count_ on
};

}  // namespace canopeer
