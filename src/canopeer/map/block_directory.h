#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/map/block.h"

namespace canopeer {

/// Where each block lies: key → slot 0, 1, 2 … in order of insertion. Open addressing with linear
/// probing, at most half full. Const calls are thread-safe.
class BlockDirectory {
 public:
  explicit BlockDirectory(std::size_t expected_blocks = 64);

  [[nodiscard]] std::optional<std::uint32_t> find(BlockKey key) const {
    for (std::size_t i = home(key);; i = (i + 1) & mask_) {
      if (entries_[i].slot == kFree) return std::nullopt;
      if (entries_[i].key == key) return entries_[i].slot;
    }
  }
  /// The block's slot; a new block gets the next one, which is the old size().
  std::uint32_t find_or_add(BlockKey key);
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t memory_bytes() const { return entries_.size() * sizeof(Entry); }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFF;
  struct Entry {
    BlockKey key = 0;
    std::uint32_t slot = kFree;
  };

  // The eight blocks of a cube of 2³ share a run of entries, for the cache's sake: rays and frames
  // touch neighbours together. The cubes are spread by Fibonacci hashing.
  std::size_t home(BlockKey key) const {
    constexpr std::uint64_t kX = 1;
    constexpr std::uint64_t kY = std::uint64_t{1} << 21;
    constexpr std::uint64_t kZ = std::uint64_t{1} << 42;
    const std::uint64_t within = (key & kX) | (key & kY) >> 20 | (key & kZ) >> 40;
    const std::uint64_t cube = key & ~(kX | kY | kZ);
    const std::uint64_t spread = (cube ^ cube >> 32) * 0x9E3779B97F4A7C15U >> shift_;
    return static_cast<std::size_t>((spread & ~std::uint64_t{7}) | within);
  }
  void grow();

  std::vector<Entry> entries_;
  std::size_t mask_ = 0;
  int shift_ = 64;
  std::size_t size_ = 0;
};

}  // namespace canopeer
