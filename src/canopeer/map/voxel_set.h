#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "canopeer/map/storage/block.h"

namespace canopeer {

/// A set of voxels as words of 64, a slice of a block each: union is an OR, size a popcount. Slices
/// without voxels are not kept; in what a view sees they are five of eight.
class VoxelSet {
 public:
  /// The voxels of one block that are in the set.
  struct Block {
    BlockKey key = 0;
    VoxelMask mask;
  };

  VoxelSet() = default;
  /// Any order, no key twice; masks may be empty.
  explicit VoxelSet(std::vector<Block> blocks);
  /// As keys(), places() and words() give them.
  VoxelSet(std::span<const BlockKey> keys, std::span<const std::uint32_t> places,
           std::span<const std::uint64_t> words)
      : keys_(keys.begin(), keys.end()),
        places_(places.begin(), places.end()),
        words_(words.begin(), words.end()) {}

  [[nodiscard]] std::int64_t count() const;
  [[nodiscard]] bool empty() const { return words_.empty(); }
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

  /// The blocks with voxels of the set, ascending.
  [[nodiscard]] std::span<const BlockKey> keys() const { return keys_; }
  /// words()[i] is slice places()[i] % 8 of block keys()[places()[i] / 8]; ascending, no word is 0.
  [[nodiscard]] std::span<const std::uint32_t> places() const { return places_; }
  [[nodiscard]] std::span<const std::uint64_t> words() const { return words_; }

  /// `visit(VoxelIndex)`, sorted by block, then z, y, x.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      VoxelMask mask;
      mask.slices[places_[i] % kBlockSide] = words_[i];
      for_each_voxel(keys_[places_[i] / kBlockSide], mask, visit);
    }
  }
  friend bool operator==(const VoxelSet&, const VoxelSet&) = default;

 private:
  using Slice = std::pair<BlockKey, std::uint32_t>;
  [[nodiscard]] Slice slice(std::size_t i) const {
    return {keys_[places_[i] / kBlockSide], places_[i] % kBlockSide};
  }
  template <typename Take>
  static void walk_both(const VoxelSet& a, const VoxelSet& b, Take&& take);
  void append(const Slice& slice, std::uint64_t word);

  std::vector<BlockKey> keys_;
  std::vector<std::uint32_t> places_;
  std::vector<std::uint64_t> words_;
};

}  // namespace canopeer
