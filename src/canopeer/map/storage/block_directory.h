#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "canopeer/map/storage/block.h"
#include "canopeer/map/storage/paged_array.h"

namespace canopeer {

/// What is to be known of a block before its voxels are looked at; one byte, bits as below.
struct BlockSummary {
  static constexpr std::uint8_t kOccupied = 1;  ///< some voxel is occupied
  static constexpr std::uint8_t kComplete = 2;  ///< all voxels are observed
  static constexpr std::uint8_t kRoi = 4;       ///< some voxel is ROI
  static constexpr std::uint8_t kSettled = 8;   ///< all voxels are as free as can be
};

/// Where each block lies: key → slot 0, 1, 2 … in order of insertion, and its summary. Blocks lie
/// in chunks of 4 × 4 × 4, so that neighbours share cache lines and few keys are hashed. Const
/// calls are thread-safe. Copies share what neither has changed since.
class BlockDirectory {
 public:
  static constexpr int kChunkShift = 2;
  static constexpr std::size_t kChunkBlocks = 64;
  static constexpr std::uint32_t kFree = 0xFFFFFFFF;

  /// 4 × 4 × 4 blocks, x fastest.
  struct Chunk {
    std::array<std::uint8_t, kChunkBlocks> summaries{};  ///< 0 for blocks that are not there
    std::array<std::uint32_t, kChunkBlocks> slots;
    Chunk() { slots.fill(kFree); }
  };

  /// Key of the chunk's first block.
  static BlockKey chunk_key(BlockKey key) { return key & kChunkMask; }
  /// Place of a block in its chunk.
  static std::size_t place_in_chunk(BlockKey key) {
    constexpr BlockKey kMask = (1 << kChunkShift) - 1;
    return static_cast<std::size_t>((key & kMask) | (key >> 21 & kMask) << kChunkShift |
                                    (key >> 42 & kMask) << 2 * kChunkShift);
  }
  /// Key of the block at a place of the chunk.
  static BlockKey key_in_chunk(BlockKey chunk_key, std::size_t place) {
    return chunk_key | (place & 3) | (place >> 2 & 3) << 21 | (place >> 4 & 3) << 42;
  }

  [[nodiscard]] std::optional<std::uint32_t> find(BlockKey key) const {
    const Chunk* found = chunk(key);
    if (found == nullptr) return std::nullopt;
    const std::uint32_t slot = found->slots[place_in_chunk(key)];
    if (slot == kFree) return std::nullopt;
    return slot;
  }
  /// The block's slot; a new block gets the next one, which is the old size().
  std::uint32_t find_or_add(BlockKey key) {
    return find_or_add(chunk_to_write(key), place_in_chunk(key));
  }
  /// The same in a chunk from chunk_to_write().
  std::uint32_t find_or_add(Chunk& chunk, std::size_t place) {
    std::uint32_t& slot = chunk.slots[place];
    if (slot == kFree) slot = static_cast<std::uint32_t>(size_++);
    return slot;
  }
  /// The chunk the block belongs to, or nullptr: no block of it is there.
  [[nodiscard]] const Chunk* chunk(BlockKey key) const {
    const std::uint32_t number = find_chunk(key & kChunkMask);
    return number == kFree ? nullptr : &chunks_[number];
  }
  /// The same for writing, made when it is not there. Stays valid until the directory is copied and
  /// written to again. Summaries of different blocks may be written at the same time.
  Chunk& chunk_to_write(BlockKey key);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return entries_.memory_bytes() + chunks_.memory_bytes();
  }

 private:
  struct Entry {
    BlockKey key = 0;  // of the chunk's first block
    std::uint32_t chunk = kFree;
  };
  using Entries = PagedArray<Entry, 256>;
  static constexpr BlockKey kChunkMask = ~(BlockKey{3} | BlockKey{3} << 21 | BlockKey{3} << 42);
  static constexpr std::size_t kFirstEntries = 256;
  static Entries empty_entries(std::size_t count);

  // Fibonacci hashing: the upper bits of the product are well mixed.
  [[nodiscard]] std::size_t home(BlockKey chunk_key) const {
    return static_cast<std::size_t>((chunk_key * 0x9E3779B97F4A7C15U) >> shift_);
  }
  [[nodiscard]] std::uint32_t find_chunk(BlockKey chunk_key) const {
    for (std::size_t i = home(chunk_key);; i = (i + 1) & mask_) {
      const Entry& entry = entries_[i];
      if (entry.chunk == kFree || entry.key == chunk_key) return entry.chunk;
    }
  }
  void insert(const Entry& entry);
  void grow();

  // Open addressing with linear probing, at most half full.
  Entries entries_ = empty_entries(kFirstEntries);
  std::size_t mask_ = kFirstEntries - 1;
  int shift_ = 56;
  PagedArray<Chunk, 16> chunks_;
  std::size_t size_ = 0;
};

}  // namespace canopeer
