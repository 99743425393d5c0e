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

bool VoxelSet::contains(const VoxelIndex& voxel) const {
  const BlockKey key = block_key(voxel);
  const auto it = std::lower_bound(blocks_.begin(), blocks_.end(), key,
                                   [](const Block& block, BlockKey k) { return block.key < k; });
  return it != blocks_.end() && it->key == key && it->mask.test(voxel);
}

void VoxelSet::merge(const VoxelSet& other) {
  std::vector<Block> merged;
  merged.reserve(blocks_.size() + other.blocks_.size());
  auto a = blocks_.begin();
  auto b = other.blocks_.begin();
  count_ = 0;
  while (a != blocks_.end() || b != other.blocks_.end()) {
    const bool take_a = b == other.blocks_.end() || (a != blocks_.end() && a->key <= b->key);
    const bool take_b = a == blocks_.end() || (b != other.blocks_.end() && b->key <= a->key);
    Block block = take_a ? *a : *b;
    if (take_a && take_b) block.mask |= b->mask;
    if (take_a) ++a;
    if (take_b) ++b;
    count_ += block.mask.count();
    merged.push_back(block);
  }
  blocks_ = std::move(merged);
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
