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

  // Fibonacci hashing: the upper bits of the product are well mixed.
  std::size_t home(BlockKey key) const {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> shift_);
  }
  void grow();

  std::vector<Entry> entries_;
  std::size_t mask_ = 0;
  int shift_ = 64;
  std::size_t size_ = 0;
};

}  // namespace canopeer
