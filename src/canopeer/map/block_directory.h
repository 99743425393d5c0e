#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "canopeer/map/block.h"

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
/// calls are thread-safe.
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

  /// Place of a block in its chunk.
  static std::size_t place_in_chunk(BlockKey key) {
    constexpr BlockKey kMask = (1 << kChunkShift) - 1;
    return static_cast<std::size_t>((key & kMask) | (key >> 21 & kMask) << kChunkShift |
                                    (key >> 42 & kMask) << 2 * kChunkShift);
  }

  [[nodiscard]] std::optional<std::uint32_t> find(BlockKey key) const {
    const Chunk* found = chunk(key);
    if (found == nullptr) return std::nullopt;
    const std::uint32_t slot = found->slots[place_in_chunk(key)];
    if (slot == kFree) return std::nullopt;
    return slot;
  }
  /// The block's slot; a new block gets the next one, which is the old size().
  std::uint32_t find_or_add(BlockKey key);
  /// The chunk the block belongs to, or nullptr: no block of it is there.
  [[nodiscard]] const Chunk* chunk(BlockKey key) const {
    const BlockKey chunk_key = key & kChunkMask;
    for (std::size_t i = home(chunk_key);; i = (i + 1) & mask_) {
      if (entries_[i].chunk == kFree) return nullptr;
      if (entries_[i].key == chunk_key) return &chunks_[entries_[i].chunk];
    }
  }
  /// The summary of a block that is there. Different blocks may be written at the same time.
  std::uint8_t& summary(BlockKey key);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return entries_.size() * sizeof(Entry) + chunks_.size() * sizeof(Chunk);
  }

 private:
  struct Entry {
    BlockKey key = 0;  // of the chunk's first block
    std::uint32_t chunk = kFree;
  };
  static constexpr BlockKey kChunkMask = ~(BlockKey{3} | BlockKey{3} << 21 | BlockKey{3} << 42);

  // Fibonacci hashing: the upper bits of the product are well mixed.
  [[nodiscard]] std::size_t home(BlockKey chunk_key) const {
    return static_cast<std::size_t>((chunk_key * 0x9E3779B97F4A7C15U) >> shift_);
  }
  Chunk& find_or_add_chunk(BlockKey chunk_key);
  void grow();

  // Open addressing with linear probing, at most half full.
  std::vector<Entry> entries_ = std::vector<Entry>(64);
  std::size_t mask_ = 63;
  int shift_ = 58;
  std::deque<Chunk> chunks_;
  std::size_t size_ = 0;
};

}  // namespace canopeer
