#include "canopeer/map/views/block_set.h"

namespace canopeer {

BlockSet::BlockSet(std::span<const BlockKey> keys) {
  if (keys.empty()) return;
  first_ = block_index(keys.front());
  VoxelIndex last = first_;
  for (const BlockKey key : keys) {
    first_ = first_.cwiseMin(block_index(key));
    last = last.cwiseMax(block_index(key));
  }
  size_ = last - first_ + VoxelIndex::Ones();
  bits_.resize(cell(last - first_) / 64 + 1);
  for (const BlockKey key : keys) {
    const std::size_t bit = cell(block_index(key) - first_);
    bits_[bit >> 6] |= std::uint64_t{1} << (bit & 63);
  }
}

std::vector<BlockKey> BlockSet::keys() const {
  std::vector<BlockKey> keys;
  for_each([&](BlockKey key) {
    keys.push_back(key);
    return true;
  });
  return keys;
}

BlockKey BlockSet::key_of(std::size_t cell) const {
  const auto x = static_cast<std::size_t>(size_.x()), y = static_cast<std::size_t>(size_.y());
  return pack_block(first_.x() + static_cast<int>(cell % x),
                    first_.y() + static_cast<int>(cell / x % y),
                    first_.z() + static_cast<int>(cell / (x * y)));
}

}  // namespace canopeer
