#include "canopeer/map/block_directory.h"

#include <utility>

#include "canopeer/base/check.h"

namespace canopeer {

std::uint32_t BlockDirectory::find_or_add(BlockKey key) {
  std::uint32_t& slot = find_or_add_chunk(key & kChunkMask).slots[place_in_chunk(key)];
  if (slot == kFree) slot = static_cast<std::uint32_t>(size_++);
  return slot;
}

std::uint8_t& BlockDirectory::summary(BlockKey key) {
  auto* found = const_cast<Chunk*>(chunk(key));
  CANOPEER_CHECK(found != nullptr, "a summary is of a block that is there");
  return found->summaries[place_in_chunk(key)];
}

BlockDirectory::Chunk& BlockDirectory::find_or_add_chunk(BlockKey chunk_key) {
  std::size_t i = home(chunk_key);
  for (; entries_[i].chunk != kFree; i = (i + 1) & mask_) {
    if (entries_[i].key == chunk_key) return chunks_[entries_[i].chunk];
  }
  entries_[i] = {chunk_key, static_cast<std::uint32_t>(chunks_.size())};
  chunks_.emplace_back();
  if (2 * chunks_.size() > entries_.size()) grow();
  return chunks_.back();
}

void BlockDirectory::grow() {
  const std::vector<Entry> old = std::exchange(entries_, std::vector<Entry>(2 * entries_.size()));
  mask_ = entries_.size() - 1;
  --shift_;
  for (const Entry& entry : old) {
    if (entry.chunk == kFree) continue;
    std::size_t i = home(entry.key);
    while (entries_[i].chunk != kFree) i = (i + 1) & mask_;
    entries_[i] = entry;
  }
}

}  // namespace canopeer
