#include "canopeer/search/cell_union.h"

#include <algorithm>
#include <bit>

namespace canopeer {

CellUnion::Prepared CellUnion::prepare(const VoxelSet& set) {
  make_room(set);
  scratch_.places.resize(kBlockSide * set.blocks().size());
  scratch_.words.resize(kBlockSide * set.blocks().size());
  std::uint32_t* const places = scratch_.places.data();
  std::uint64_t* const words = scratch_.words.data();
  std::size_t kept = 0;
  for (const auto& block : set.blocks()) {
    std::uint32_t& number = number_[cell(block_index(block.key))];
    if (number == kNew) number = count_++;
    for (std::uint32_t slice = 0; slice < kBlockSide; ++slice) {
      // No branch on what is in the slice: it would be mispredicted.
      places[kept] = number * kBlockSide + slice;
      words[kept] = block.mask.slices[slice];
      kept += words[kept] != 0 ? 1 : 0;
    }
  }
  words_.resize(std::size_t{count_} * kBlockSide);
  return {.places = {places, places + kept}, .words = {words, words + kept}};
}

// A larger window than the set needs, so that few sets make it grow.
void CellUnion::make_room(const VoxelSet& set) {
  if (set.empty()) return;
  constexpr int kMargin = 6;
  VoxelIndex low = block_index(set.blocks().front().key);
  VoxelIndex high = low;
  for (const auto& block : set.blocks()) {
    const VoxelIndex at = block_index(block.key);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const VoxelIndex end = first_ + blocks_;
  if ((low.array() >= first_.array()).all() && (high.array() < end.array()).all()) return;

  CellUnion larger;
  larger.first_ = low.array() - kMargin;
  VoxelIndex larger_end = high.array() + kMargin + 1;
  if (!number_.empty()) {
    larger.first_ = larger.first_.cwiseMin(first_);
    larger_end = larger_end.cwiseMax(end);
  }
  larger.blocks_ = larger_end - larger.first_;
  larger.number_.assign(static_cast<std::size_t>(larger.blocks_.cast<std::int64_t>().prod()), kNew);
  for (int z = 0; z < blocks_.z(); ++z) {
    for (int y = 0; y < blocks_.y(); ++y) {
      const VoxelIndex row = first_ + VoxelIndex(0, y, z);
      std::copy_n(number_.begin() + static_cast<std::ptrdiff_t>(cell(row)), blocks_.x(),
                  larger.number_.begin() + static_cast<std::ptrdiff_t>(larger.cell(row)));
    }
  }
  first_ = larger.first_;
  blocks_ = larger.blocks_;
  number_ = std::move(larger.number_);
}

void CellUnion::clear() {
  for (const std::uint32_t place : written_) words_[place] = 0;
  written_.clear();
}

void CellUnion::add(const Prepared& set) {
  for (std::size_t i = 0; i < set.places.size(); ++i) words_[set.places[i]] |= set.words[i];
  written_.insert(written_.end(), set.places.begin(), set.places.end());
}

std::int64_t CellUnion::count_new(const Prepared& set) const {
  std::int64_t fresh = 0;
  for (std::size_t i = 0; i < set.places.size(); ++i) {
    fresh += std::popcount(set.words[i] & ~words_[set.places[i]]);
  }
  return fresh;
}

}  // namespace canopeer
