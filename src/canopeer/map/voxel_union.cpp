#include "canopeer/map/voxel_union.h"

#include <bit>

namespace canopeer {

// A place that is taken by another block is followed by the next; at most half of them are taken.
std::size_t VoxelUnion::place_of(BlockKey key) const {
  std::size_t i = home(key);
  while (numbers_[i] != kNone && keys_[numbers_[i]] != key) i = (i + 1) & (numbers_.size() - 1);
  return i;
}

std::uint32_t VoxelUnion::find_beside(BlockKey key) {
  const std::size_t i = place_of(key);
  if (numbers_[i] == kNone) {
    numbers_[i] = count_;
    keys_[count_++] = key;
  }
  return numbers_[i];
}

void VoxelUnion::grow() {
  ++bits_;
  numbers_.assign(std::size_t{1} << 3 * bits_, kNone);
  const std::uint32_t count = count_;
  for (count_ = 0; count_ < count;) find_beside(keys_[count_]);
}

void VoxelUnion::clear() {
  // The last one first: nothing lies behind a place that has been freed.
  while (count_ > 0) {
    --count_;
    std::size_t i = home(keys_[count_]);
    while (numbers_[i] != count_) i = (i + 1) & (numbers_.size() - 1);
    numbers_[i] = kNone;
    masks_[count_] = {};
  }
}

void VoxelUnion::add(const VoxelSet& set) {
  const std::size_t most = count_ + set.keys().size();
  while (most > numbers_.size() / 2) grow();
  if (most > masks_.size()) {
    masks_.resize(2 * most);
    keys_.resize(2 * most);
  }
  of_set_.resize(set.keys().size());
  std::uint32_t* of_set = of_set_.data();
  for (const BlockKey key : set.keys()) {
    std::uint32_t& place = numbers_[home(key)];
    // No branch on whether the block is new: it would be mispredicted.
    const bool is_new = place == kNone;
    std::uint32_t number = is_new ? count_ : place;
    if (!is_new & (keys_[number] != key)) [[unlikely]] {
      number = find_beside(key);
    } else {
      place = number;
      keys_[number] = key;
      count_ += is_new ? 1 : 0;
    }
    *of_set++ = number;
  }
  for (std::size_t i = 0; i < set.words().size(); ++i) {
    const std::uint32_t place = set.places()[i];
    masks_[of_set_[place / kBlockSide]].slices[place % kBlockSide] |= set.words()[i];
  }
}

std::int64_t VoxelUnion::count() const {
  std::int64_t count = 0;
  for (std::uint32_t i = 0; i < count_; ++i) count += masks_[i].count();
  return count;
}

std::int64_t VoxelUnion::count_new(const VoxelSet& set) const {
  static constexpr Mask kNothing{};
  std::int64_t fresh = 0;
  std::size_t i = 0;
  for (std::size_t block = 0; block < set.keys().size(); ++block) {
    const BlockKey key = set.keys()[block];
    std::uint32_t number = numbers_[home(key)];
    if (number != kNone && keys_[number] != key) [[unlikely]]
      number = numbers_[place_of(key)];
    const Mask& mask = number == kNone ? kNothing : masks_[number];
    for (; i < set.words().size() && set.places()[i] / kBlockSide == block; ++i) {
      fresh += std::popcount(set.words()[i] & ~mask.slices[set.places()[i] % kBlockSide]);
    }
  }
  return fresh;
}

VoxelSet VoxelUnion::set() const {
  std::vector<VoxelSet::Block> blocks(count_);
  for (std::uint32_t i = 0; i < count_; ++i) blocks[i] = {keys_[i], masks_[i]};
  return VoxelSet(std::move(blocks));
}

}  // namespace canopeer
