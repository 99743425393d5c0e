#include "canopeer/map/storage/block_directory.h"

#include <utility>

namespace canopeer {

BlockDirectory::Entries BlockDirectory::empty_entries(std::size_t count) {
  Entries entries;
  entries.resize(count, Entry{});
  return entries;
}

BlockDirectory::Chunk& BlockDirectory::chunk_to_write(BlockKey key) {
  const BlockKey chunk_key = key & kChunkMask;
  const std::uint32_t found = find_chunk(chunk_key);
  if (found != kFree) return chunks_.own(found);
  const auto added = static_cast<std::uint32_t>(chunks_.push_back(Chunk{}));
  insert({chunk_key, added});
  if (2 * chunks_.size() > entries_.size()) grow();
  return chunks_.own(added);
}

void BlockDirectory::insert(const Entry& entry) {
  std::size_t i = home(entry.key);
  while (entries_[i].chunk != kFree) i = (i + 1) & mask_;
  entries_.own(i) = entry;
}

void BlockDirectory::grow() {
  const Entries old = std::exchange(entries_, empty_entries(2 * entries_.size()));
  mask_ = entries_.size() - 1;
  --shift_;
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (old[i].chunk != kFree) insert(old[i]);
  }
}

}  // namespace canopeer
