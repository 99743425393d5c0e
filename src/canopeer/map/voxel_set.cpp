#include "canopeer/map/voxel_set.h"

#include <algorithm>

namespace canopeer {

VoxelSet::VoxelSet(std::vector<Block> blocks) {
  const auto by_key = [](const Block& a, const Block& b) { return a.key < b.key; };
  if (!std::is_sorted(blocks.begin(), blocks.end(), by_key)) {
    std::sort(blocks.begin(), blocks.end(), by_key);
  }
  for (const Block& block : blocks) {
    for (std::uint32_t z = 0; z < kBlockSide; ++z) append({block.key, z}, block.mask.slices[z]);
  }
}

// Slices come in ascending order.
void VoxelSet::append(const Slice& slice, std::uint64_t word) {
  if (word == 0) return;
  if (keys_.empty() || keys_.back() != slice.first) keys_.push_back(slice.first);
  places_.push_back(static_cast<std::uint32_t>(keys_.size() - 1) * kBlockSide + slice.second);
  words_.push_back(word);
}

std::int64_t VoxelSet::count() const {
  std::int64_t count = 0;
  for (const std::uint64_t word : words_) count += std::popcount(word);
  return count;
}

bool VoxelSet::contains(const VoxelIndex& voxel) const {
  const auto key = std::lower_bound(keys_.begin(), keys_.end(), block_key(voxel));
  if (key == keys_.end() || *key != block_key(voxel)) return false;
  const auto place =
      static_cast<std::uint32_t>((key - keys_.begin()) * kBlockSide + VoxelMask::slice_of(voxel));
  const auto found = std::lower_bound(places_.begin(), places_.end(), place);
  if (found == places_.end() || *found != place) return false;
  return (words_[static_cast<std::size_t>(found - places_.begin())] & VoxelMask::bit_of(voxel)) !=
         0;
}

// `take(slice, its word in a, its word in b)`, in ascending order.
template <typename Take>
void VoxelSet::walk_both(const VoxelSet& a, const VoxelSet& b, Take&& take) {
  constexpr Slice kEnd{~BlockKey{0}, 0};
  std::size_t i = 0, j = 0;
  while (i < a.words_.size() || j < b.words_.size()) {
    const Slice of_a = i < a.words_.size() ? a.slice(i) : kEnd;
    const Slice of_b = j < b.words_.size() ? b.slice(j) : kEnd;
    take(std::min(of_a, of_b), of_a <= of_b ? a.words_[i++] : 0, of_b <= of_a ? b.words_[j++] : 0);
  }
}

void VoxelSet::merge(const VoxelSet& other) {
  VoxelSet both;
  walk_both(*this, other, [&](const Slice& slice, std::uint64_t mine, std::uint64_t theirs) {
    both.append(slice, mine | theirs);
  });
  *this = std::move(both);
}

void VoxelSet::subtract(const VoxelSet& other) {
  VoxelSet rest;
  walk_both(*this, other, [&](const Slice& slice, std::uint64_t mine, std::uint64_t theirs) {
    rest.append(slice, mine & ~theirs);
  });
  *this = std::move(rest);
}

std::int64_t VoxelSet::count_new(const VoxelSet& other) const {
  std::int64_t fresh = 0;
  walk_both(*this, other, [&](const Slice&, std::uint64_t mine, std::uint64_t theirs) {
    fresh += std::popcount(theirs & ~mine);
  });
  return fresh;
}

}  // namespace canopeer
