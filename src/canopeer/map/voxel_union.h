#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_set.h"

namespace canopeer {

/// The union of many voxel sets, one after the other, each used a few times only (sets used often
/// are worth preparing: CellUnion). A table that follows from their indices finds the blocks. So
/// adding a set, or counting what it would add, costs what it holds, however much is there already.
/// The memory is used again after clear().
class VoxelUnion {
 public:
  void clear();
  void add(const VoxelSet& set);
  [[nodiscard]] std::int64_t count() const;
  /// |set \ this|: by how much add(set) would make the union grow.
  [[nodiscard]] std::int64_t count_new(const VoxelSet& set) const;
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
  /// The place of a block, or the free one it would get.
  [[nodiscard]] std::size_t place_of(BlockKey key) const;
  /// The number of a block whose place is taken by another; a new one when it is not there.
  std::uint32_t find_beside(BlockKey key);
  void grow();

  int bits_ = 5;
  std::vector<std::uint32_t> numbers_ = std::vector<std::uint32_t>(std::size_t{1} << 15, kNone);
  std::uint32_t count_ = 0;  // of blocks
  std::vector<BlockKey> keys_;
  std::vector<Mask> masks_;            // empty from count_ on
  std::vector<std::uint32_t> of_set_;  // the numbers of the blocks of the set being added
};

}  // namespace canopeer
