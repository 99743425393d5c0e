#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_set.h"

namespace canopeer {

/// A voxel set laid out for one union at a time, over and over: C(n) of the node a search expands.
/// Sets are prepared once (their blocks are numbered, and only the words with voxels in them kept);
/// adding one is then an OR per word, counting what it would add an AND and a popcount. Memory
/// grows with the number of prepared sets and of distinct blocks, and by four bytes a block of the
/// box around all of them: the sets are meant to be of views that lie some metres apart.
class CellUnion {
 public:
  /// A set's non-empty 64 voxel slices by number of place.
  struct Prepared {
    std::vector<std::uint32_t> places;
    std::vector<std::uint64_t> words;
  };

  [[nodiscard]] Prepared prepare(const VoxelSet& set);
  /// Empties the union; prepared sets stay valid.
  void clear();
  void add(const Prepared& set);
  /// |set \ union|: by how much add(set) would make the union grow.
  [[nodiscard]] std::int64_t count_new(const Prepared& set) const;

 private:
  static constexpr std::uint32_t kNew = 0xFFFFFFFF;

  void make_room(const VoxelSet& set);
  [[nodiscard]] std::size_t cell(const VoxelIndex& block) const {
    const VoxelIndex at = block - first_;
    return static_cast<std::size_t>((at.z() * blocks_.y() + at.y()) * blocks_.x() + at.x());
  }

  VoxelIndex first_ = VoxelIndex::Zero();   // the window of blocks that have a cell
  VoxelIndex blocks_ = VoxelIndex::Zero();  // its size
  std::vector<std::uint32_t> number_;       // by cell: kNew, or the block's number
  std::uint32_t count_ = 0;                 // of numbered blocks
  std::vector<std::uint64_t> words_;        // by place: block number · 8 + slice
  std::vector<std::uint32_t> written_;      // places that are not empty, maybe more than once
  Prepared scratch_;
};

}  // namespace canopeer
