#include "canopeer/search/cell_union.h"

#include <algorithm>
#include <bit>

namespace canopeer {

CellUnion::Prepared CellUnion::prepare(const VoxelSet& set) {
  if (!find_cells(set)) {
    make_room(set);
    find_cells(set);
  }
  Prepared prepared{std::vector<std::uint32_t>(set.keys().size()),
                    {set.places().begin(), set.places().end()}};
  for (std::size_t i = 0; i < prepared.blocks.size(); ++i) {
    // No branch on what is new: it would be mispredicted.
    std::uint32_t& number = number_[cells_[i]];
    const bool is_new = number == kNew;
    number = is_new ? count_ : number;
    prepared.blocks[i] = number;
    count_ += is_new ? 1 : 0;
  }
  words_.resize(std::size_t{count_} * kBlockSide);
  for (std::uint32_t& place : prepared.places) {
    place = prepared.blocks[place / kBlockSide] * kBlockSide + place % kBlockSide;
  }
  return prepared;
}

// Returns whether all blocks of the set lie in the window.
bool CellUnion::find_cells(const VoxelSet& set) {
  cells_.resize(set.keys().size());
  std::uint32_t* cells = cells_.data();
  bool room = true;
  for (const BlockKey key : set.keys()) {
    const VoxelIndex at = block_index(key) - first_;
    const auto x = static_cast<std::uint32_t>(at.x()), y = static_cast<std::uint32_t>(at.y()),
               z = static_cast<std::uint32_t>(at.z());
    const auto columns = static_cast<std::uint32_t>(blocks_.x()),
               rows = static_cast<std::uint32_t>(blocks_.y()),
               layers = static_cast<std::uint32_t>(blocks_.z());
    room &= (x < columns) & (y < rows) & (z < layers);
    *cells++ = (z * rows + y) * columns + x;
  }
  return room;
}

// A larger window than the set needs, so that few sets make it grow.
void CellUnion::make_room(const VoxelSet& set) {
  constexpr int kMargin = 6;
  VoxelIndex low = block_index(set.keys().front());
  VoxelIndex high = low;
  for (const BlockKey key : set.keys()) {
    low = low.cwiseMin(block_index(key));
    high = high.cwiseMax(block_index(key));
  }
  const VoxelIndex end = first_ + blocks_;

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
  for (const std::uint32_t block : written_) {
    std::fill_n(words_.data() + std::size_t{block} * kBlockSide, kBlockSide, std::uint64_t{0});
  }
  written_.clear();
}

void CellUnion::add(const VoxelSet& set, const Prepared& prepared) {
  const std::uint64_t* const words = set.words().data();
  const std::uint32_t* const places = prepared.places.data();
  for (std::size_t i = 0; i < set.words().size(); ++i) words_[places[i]] |= words[i];
  written_.insert(written_.end(), prepared.blocks.begin(), prepared.blocks.end());
}

std::int64_t CellUnion::count_new(const VoxelSet& set, const Prepared& prepared) const {
  const std::uint64_t* const words = set.words().data();
  const std::uint32_t* const places = prepared.places.data();
  std::int64_t fresh = 0;
  for (std::size_t i = 0; i < set.words().size(); ++i) {
    fresh += std::popcount(words[i] & ~words_[places[i]]);
  }
  return fresh;
}

}  // namespace canopeer
