#include "canopeer/map/storage/block_key_order.h"

#include <algorithm>
#include <bit>

namespace canopeer {

void sort_keys(std::vector<BlockKey>& keys) {
  if (keys.size() < 64) return std::sort(keys.begin(), keys.end());
  VoxelIndex low = block_index(keys.front()), high = low;
  for (const BlockKey key : keys) {
    low = low.cwiseMin(block_index(key));
    high = high.cwiseMax(block_index(key));
  }
  const VoxelIndex size = high - low + VoxelIndex::Ones();
  // Rows are whole words.
  const auto row = static_cast<std::size_t>((size.x() + 63) / 64);
  const double words = static_cast<double>(row) * size.y() * size.z();
  if (words > static_cast<double>(keys.size())) return std::sort(keys.begin(), keys.end());
  std::vector<std::uint64_t> bits(static_cast<std::size_t>(words), 0);
  for (const BlockKey key : keys) {
    const VoxelIndex at = block_index(key) - low;
    const std::size_t line = static_cast<std::size_t>(at.z()) * static_cast<std::size_t>(size.y()) +
                             static_cast<std::size_t>(at.y());
    bits[line * row + static_cast<std::size_t>(at.x() / 64)] |= std::uint64_t{1} << at.x() % 64;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    const auto line = static_cast<int>(i / row), word = static_cast<int>(i % row);
    const BlockKey first =
        pack_block(low.x() + 64 * word, low.y() + line % size.y(), low.z() + line / size.y());
    for (std::uint64_t rest = bits[i]; rest != 0; rest &= rest - 1) {
      keys[count++] = first + static_cast<BlockKey>(std::countr_zero(rest));
    }
  }
}

}  // namespace canopeer
