#include "canopeer/map/block_surroundings.h"

namespace canopeer {

BlockSurroundings::BlockSurroundings(const VoxelMap& map, const std::vector<BlockKey>& keys) {
  VoxelIndex low = block_index(keys.front());
  VoxelIndex high = low;
  for (const BlockKey key : keys) {
    low = low.cwiseMin(block_index(key));
    high = high.cwiseMax(block_index(key));
  }
  first_ = low - VoxelIndex::Constant(2);
  size_ = high - low + VoxelIndex::Constant(5);
  flags_.reserve(static_cast<std::size_t>(size_.cast<std::int64_t>().prod()));
  for (int z = 0; z < size_.z(); ++z) {
    for (int y = 0; y < size_.y(); ++y) {
      const BlockDirectory::Chunk* chunk = nullptr;
      for (int x = 0; x < size_.x(); ++x) {
        const VoxelIndex b = first_ + VoxelIndex(x, y, z);
        const BlockKey key = pack_block(b.x(), b.y(), b.z());
        const bool next_chunk = (b.x() & ((1 << BlockDirectory::kChunkShift) - 1)) == 0;
        if (x == 0 || next_chunk) chunk = map.chunk(key);
        const unsigned summary =
            chunk == nullptr ? 0U : chunk->summaries[BlockDirectory::place_in_chunk(key)];
        flags_.push_back(
            static_cast<std::uint8_t>(((summary & BlockSummary::kComplete) == 0 ? kUnknown : 0) |
                                      ((summary & BlockSummary::kRoi) != 0 ? kRoi : 0)));
      }
    }
  }
  const auto row = static_cast<std::size_t>(size_.x());
  spread(1);
  spread(row);
  spread(row * static_cast<std::size_t>(size_.y()));
}

std::size_t BlockSurroundings::cell(BlockKey key) const {
  const VoxelIndex b = block_index(key) - first_;
  return static_cast<std::size_t>((b.z() * size_.y() + b.y()) * size_.x() + b.x());
}

// Gives each cell what its two neighbours at this stride hold. The outermost cells are no one's
// centre, so what wraps around into them does not matter.
void BlockSurroundings::spread(std::size_t stride) {
  const std::vector<std::uint8_t> before = flags_;
  for (std::size_t i = stride; i + stride < flags_.size(); ++i) {
    flags_[i] = static_cast<std::uint8_t>(before[i] | before[i - stride] | before[i + stride]);
  }
}

}  // namespace canopeer
