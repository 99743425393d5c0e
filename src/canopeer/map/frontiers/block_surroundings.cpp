#include "canopeer/map/frontiers/block_surroundings.h"

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
  const std::size_t layer = row * static_cast<std::size_t>(size_.y());
  for (const std::size_t stride : {std::size_t{1}, row, layer}) spread_flags(stride, flags_);
}

std::size_t BlockSurroundings::cell(BlockKey key) const {
  const VoxelIndex b = block_index(key) - first_;
  return static_cast<std::size_t>((b.z() * size_.y() + b.y()) * size_.x() + b.x());
}

void spread_flags(std::size_t stride, std::vector<std::uint8_t>& flags) {
  const std::vector<std::uint8_t> copy = flags;
  const std::uint8_t* before = copy.data();
  std::uint8_t* now = flags.data();
  for (std::size_t i = stride; i + stride < copy.size(); ++i) {
    now[i] = static_cast<std::uint8_t>(before[i] | before[i - stride] | before[i + stride]);
  }
}

}  // namespace canopeer
