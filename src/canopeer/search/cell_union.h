#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_set.h"

namespace canopeer {

/// A voxel set laid out for one union at a time, over and over: C(n) of the node a search expands.
/// Sets are prepared once: their blocks are numbered. Then adding one is an OR per word; counting
/// what it would add is an AND and a popcount. Memory grows with the number of distinct blocks and
/// of words of the prepared sets, and by four bytes a block of the box around all of them. So the
/// sets should be of views that lie some metres apart.
class CellUnion {
 public:
  /// Where a set belongs.
  struct Prepared {
    std::vector<std::uint32_t> blocks;  ///< numbers
    std::vector<std::uint32_t> places;  ///< of the words: block number · 8 + slice
  };

  [[nodiscard]] Prepared prepare(const VoxelSet& set);
  /// Empties the union; prepared sets stay valid.
  void clear();
  /// `prepared`: what prepare() gave for the set.
  void add(const VoxelSet& set, const Prepared& prepared);
  /// |set \ union|: by how much add(set) would make the union grow.
  [[nodiscard]] std::int64_t count_new(const VoxelSet& set, const Prepared& prepared) const;

 private:
  static constexpr std::uint32_t kNew = 0xFFFFFFFF;

  bool find_cells(const VoxelSet& set);
  void make_room(const VoxelSet& set);
  [[nodiscard]] std::size_t cell(const VoxelIndex& block) const {
    const VoxelIndex at = block - first_;
    return static_cast<std::size_t>((at.z() * blocks_.y() + at.y()) * blocks_.x() + at.x());
  }

  VoxelIndex first_ = VoxelIndex::Zero();   // the window of blocks that have a cell
  VoxelIndex blocks_ = VoxelIndex::Zero();  // its size
  std::vector<std::uint32_t> number_;       // by cell: kNew, or the block's number
  std::uint32_t count_ = 0;                 // of numbered blocks
  std::vector<std::uint64_t> words_;        // by place
  std::vector<std::uint32_t> written_;      // blocks that are not empty, maybe more than once
  std::vector<std::uint32_t> cells_;        // of the blocks of the set being prepared
};

}  // namespace canopeer
