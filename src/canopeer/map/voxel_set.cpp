#include "canopeer/map/voxel_set.h"

#include <algorithm>

namespace canopeer {

VoxelSet::VoxelSet(std::vector<Block> blocks) : blocks_(std::move(blocks)) {
  std::erase_if(blocks_, [](const Block& block) { return !block.mask.any(); });
  const auto by_key = [](const Block& a, const Block& b) { return a.key < b.key; };
  if (!std::is_sorted(blocks_.begin(), blocks_.end(), by_key)) {
    std::sort(blocks_.begin(), blocks_.end(), by_key);
  }
  for (const Block& block : blocks_) count_ += block.mask.count();
}

VoxelSet VoxelSet::of_sorted(std::vector<Block> blocks) {
  VoxelSet set;
  set.blocks_ = std::move(blocks);
  for (const Block& block : set.blocks_) set.count_ += block.mask.count();
  return set;
}

bool VoxelSet::contains(const VoxelIndex& voxel) const {
  const BlockKey key = block_key(voxel);
  const auto it = std::lower_bound(blocks_.begin(), blocks_.end(), key,
                                   [](const Block& block, BlockKey k) { return block.key < k; });
  return it != blocks_.end() && it->key == key && it->mask.test(voxel);
}

// In place: blocks both have take the other's bits; room for the rest is made from the back. Only
// what both have is counted.
void VoxelSet::merge(const VoxelSet& other) {
  std::size_t missing = 0;
  count_ += other.count_;
  std::size_t i = 0;
  for (const Block& block : other.blocks_) {
    while (i < blocks_.size() && blocks_[i].key < block.key) ++i;
    if (i == blocks_.size() || blocks_[i].key != block.key) {
      ++missing;
      continue;
    }
    VoxelMask common = block.mask;
    common &= blocks_[i].mask;
    count_ -= common.count();
    blocks_[i].mask |= block.mask;
  }
  if (missing == 0) return;
  std::size_t a = blocks_.size();
  std::size_t b = other.blocks_.size();
  std::size_t out = a + missing;
  blocks_.resize(out);
  while (out > a) {
    if (a > 0 && blocks_[a - 1].key >= other.blocks_[b - 1].key) {
      if (blocks_[a - 1].key == other.blocks_[b - 1].key) --b;
      blocks_[--out] = blocks_[--a];
    } else {
      blocks_[--out] = other.blocks_[--b];
    }
  }
}

void VoxelSet::subtract(const VoxelSet& other) {
  auto b = other.blocks_.begin();
  count_ = 0;
  for (Block& block : blocks_) {
    while (b != other.blocks_.end() && b->key < block.key) ++b;
    if (b != other.blocks_.end() && b->key == block.key) block.mask -= b->mask;
    count_ += block.mask.count();
  }
  std::erase_if(blocks_, [](const Block& block) { return !block.mask.any(); });
}

std::int64_t VoxelSet::count_new(const VoxelSet& other) const {
  std::int64_t fresh = 0;
  auto a = blocks_.begin();
  for (const Block& block : other.blocks_) {
    while (a != blocks_.end() && a->key < block.key) ++a;
    VoxelMask mask = block.mask;
    if (a != blocks_.end() && a->key == block.key) mask -= a->mask;
    fresh += mask.count();
  }
  return fresh;
}

}  // namespace canopeer
