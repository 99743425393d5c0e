#include "canopeer/search/cell_union.h"

#include <algorithm>
#include <bit>

namespace canopeer {

CellUnion::Prepared CellUnion::prepare(const VoxelSet& set) {
  Prepared prepared;
  // A ray fan leaves two or three slices of a block with voxels in them.
  prepared.places.reserve(3 * set.blocks().size());
  prepared.words.reserve(3 * set.blocks().size());
  for (const auto& block : set.blocks()) {
    const std::uint32_t first = blocks_.find_or_add(block.key) * kBlockSide;
    for (std::uint32_t slice = 0; slice < kBlockSide; ++slice) {
      const std::uint64_t word = block.mask.slices[slice];
      if (word == 0) continue;
      prepared.places.push_back(first + slice);
      prepared.words.push_back(word);
    }
  }
  words_.resize(blocks_.size() * kBlockSide);
  return prepared;
}

void CellUnion::clear() {
  for (const std::uint32_t block : written_) {
    std::fill_n(words_.begin() + block * kBlockSide, kBlockSide, std::uint64_t{0});
  }
  written_.clear();
}

void CellUnion::add(const Prepared& set) {
  std::uint32_t last = UINT32_MAX;  // a block's slices follow each other
  for (std::size_t i = 0; i < set.places.size(); ++i) {
    const std::uint32_t place = set.places[i];
    words_[place] |= set.words[i];
    if (place / kBlockSide != last) {
      last = place / kBlockSide;
      written_.push_back(last);
    }
  }
}

std::int64_t CellUnion::count_new(const Prepared& set) const {
  std::int64_t fresh = 0;
  for (std::size_t i = 0; i < set.places.size(); ++i) {
    fresh += std::popcount(set.words[i] & ~words_[set.places[i]]);
  }
  return fresh;
}

}  // namespace canopeer
