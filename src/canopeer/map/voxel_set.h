#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "canopeer/map/block.h"

namespace canopeer {

/// A set of voxels as bit masks of the blocks they lie in: union is an OR, size a popcount.
class VoxelSet {
 public:
  struct Block {
    BlockKey key = 0;
    VoxelMask mask;
    friend bool operator==(const Block&, const Block&) = default;
  };

  VoxelSet() = default;
  /// Blocks with empty masks are dropped; no key twice, any order.
  explicit VoxelSet(std::vector<Block> blocks);
  /// The same of blocks sorted by key, none of them empty.
  static VoxelSet of_sorted(std::vector<Block> blocks);

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] bool contains(const VoxelIndex& voxel) const;
  /// Adds the voxels of `other`.
  void merge(const VoxelSet& other);
  /// Removes the voxels of `other`.
  void subtract(const VoxelSet& other);
  /// |other \ this|: by how much merge(other) would grow this set.
  [[nodiscard]] std::int64_t count_new(const VoxelSet& other) const;
  /// Σ weight(VoxelIndex) over the voxels, in the order of for_each().
  template <typename Weight>
  [[nodiscard]] double weighted_count(Weight&& weight) const {
    double sum = 0.0;
    for_each([&](const VoxelIndex& voxel) { sum += weight(voxel); });
    return sum;
  }
  /// Sorted by key, no mask empty.
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

  /// `visit(VoxelIndex)`, sorted by block, then z, y, x.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (const Block& block : blocks_) for_each_voxel(block.key, block.mask, visit);
  }
  friend bool operator==(const VoxelSet& a, const VoxelSet& b) { return a.blocks_ == b.blocks_; }

 private:
  std::vector<Block> blocks_;
  std::int64_t count_ = 0;
};

}  // namespace canopeer
