#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "canopeer/map/storage/block.h"

namespace canopeer {

/// Blocks of a box, a bit each: small, and quick to ask.
class BlockSet {
 public:
  BlockSet() = default;
  /// `bits` of the blocks from `first` on, `size` of them per axis, x fastest, 64 a word; none
  /// beyond the last.
  BlockSet(const VoxelIndex& first, const VoxelIndex& size, std::span<const std::uint64_t> bits)
      : first_(first), size_(size), bits_(bits.begin(), bits.end()) {}
  explicit BlockSet(std::span<const BlockKey> keys);

  [[nodiscard]] bool contains(BlockKey key) const {
    const VoxelIndex at = block_index(key) - first_;
    const auto inside = [&](int axis) {
      return static_cast<unsigned>(at[axis]) < static_cast<unsigned>(size_[axis]);
    };
    if (!(inside(0) && inside(1) && inside(2))) return false;
    const std::size_t bit = cell(at);
    return (bits_[bit >> 6] >> (bit & 63) & 1) != 0;
  }
  /// Ascending.
  [[nodiscard]] std::vector<BlockKey> keys() const;
  /// `visit(BlockKey)` returns whether to go on; ascending. Returns false when stopped.
  template <typename Visit>
  bool for_each(Visit&& visit) const {
    for (std::size_t word = 0; word < bits_.size(); ++word) {
      for (std::uint64_t bits = bits_[word]; bits != 0; bits &= bits - 1) {
        if (!visit(key_of(64 * word + static_cast<std::size_t>(std::countr_zero(bits)))))
          return false;
      }
    }
    return true;
  }
  /// Of the same blocks.
  friend bool operator==(const BlockSet& a, const BlockSet& b) { return a.keys() == b.keys(); }

 private:
  [[nodiscard]] std::size_t cell(const VoxelIndex& at) const {
    return (static_cast<std::size_t>(at.z()) * static_cast<std::size_t>(size_.y()) +
            static_cast<std::size_t>(at.y())) *
               static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(at.x());
  }
  [[nodiscard]] BlockKey key_of(std::size_t cell) const;

  VoxelIndex first_ = VoxelIndex::Zero();
  VoxelIndex size_ = VoxelIndex::Zero();
  std::vector<std::uint64_t> bits_;
};

}  // namespace canopeer
