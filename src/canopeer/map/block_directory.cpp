#include "canopeer/map/block_directory.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace canopeer {

BlockDirectory::BlockDirectory(std::size_t expected_blocks)
    : entries_(std::bit_ceil(std::max<std::size_t>(2 * expected_blocks, 16))),
      mask_(entries_.size() - 1),
      shift_(64 - std::countr_zero(entries_.size())) {}

std::uint32_t BlockDirectory::find_or_add(BlockKey key) {
  std::size_t i = home(key);
  for (; entries_[i].slot != kFree; i = (i + 1) & mask_) {
    if (entries_[i].key == key) return entries_[i].slot;
  }
  entries_[i] = {key, static_cast<std::uint32_t>(size_)};
  if (2 * ++size_ > entries_.size()) grow();
  return static_cast<std::uint32_t>(size_ - 1);
}

void BlockDirectory::grow() {
  const std::vector<Entry> old = std::exchange(entries_, std::vector<Entry>(2 * entries_.size()));
  mask_ = entries_.size() - 1;
  --shift_;
  for (const Entry& entry : old) {
    if (entry.slot == kFree) continue;
    std::size_t i = home(entry.key);
    while (entries_[i].slot != kFree) i = (i + 1) & mask_;
    entries_[i] = entry;
  }
}

}  // namespace canopeer
