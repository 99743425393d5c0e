#include "canopeer/map/distance_field.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/map/distance_tile.h"

namespace canopeer {
namespace {

constexpr int kMaxReach = 120;  // 2 · reach² must fit 16 bits

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

DistanceField::DistanceField(const DistanceFieldOptions& options, double resolution_m)
    : world_(options.world),
      resolution_m_(resolution_m),
      truncation_m_(options.truncation_m),
      to_(options.to) {
  CANOPEER_CHECK(!world_.isEmpty() && world_.sizes().allFinite(),
                 "a distance field needs a finite box");
  reach_ = static_cast<int>(std::ceil(truncation_m_ / resolution_m_ - 1e-9));
  CANOPEER_CHECK(reach_ >= 1 && reach_ <= kMaxReach, "truncation_m must be 1 to 120 voxels");
  halo_ = (reach_ + kBlockSide - 1) / kBlockSide;
  const double block_m = kBlockSide * resolution_m_;
  first_block_ = voxel_at(world_.min(), block_m);
  const VoxelIndex last_block = voxel_at(world_.max(), block_m);
  tiles_ = (last_block - first_block_) / kTileBlocks + VoxelIndex::Ones();
  grid_size_ = tiles_ * kTileBlocks + VoxelIndex::Constant(2 * halo_);
  const auto volume = [](const VoxelIndex& size) {
    return static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()) *
           static_cast<std::size_t>(size.z());
  };
  occupied_.resize(volume(grid_size_), obstacles(nullptr));
  distance2_.resize(volume(tiles_));
  for (int d2 = 0; d2 <= reach_ * reach_; ++d2) {
    root_m_.push_back(static_cast<float>(std::min(std::sqrt(d2) * resolution_m_, truncation_m_)));
  }
  // Nothing is known yet, and that may be what distances are to.
  if (to_ == DistanceTo::occupied_or_unknown) {
    compute(std::vector<std::uint8_t>(distance2_.size(), 1));
  }
}

VoxelMask DistanceField::obstacles(const BlockMasks* block) const {
  const bool to_unknown = to_ == DistanceTo::occupied_or_unknown;
  if (block == nullptr) return to_unknown ? VoxelMask::all() : VoxelMask{};
  if (to_ == DistanceTo::roi) return block->roi;
  if (!to_unknown) return block->occupied;
  VoxelMask mask = VoxelMask::all();
  mask -= block->observed;
  mask |= block->occupied;
  return mask;
}

std::size_t DistanceField::tile_number(const VoxelIndex& tile) const {
  return static_cast<std::size_t>((tile.z() * tiles_.y() + tile.y()) * tiles_.x() + tile.x());
}

float DistanceField::distance(const Vec3& p_world) const {
  if (!world_.contains(p_world)) return static_cast<float>(truncation_m_);
  const VoxelIndex voxel = voxel_at(p_world, resolution_m_) - first_block_ * kBlockSide;
  constexpr int kShift = 5;
  static_assert(1 << kShift == kTileSide);
  const VoxelIndex tile_index(voxel.x() >> kShift, voxel.y() >> kShift, voxel.z() >> kShift);
  const Tile& tile = distance2_[tile_number(tile_index)];
  if (tile.empty()) return static_cast<float>(truncation_m_);
  constexpr int kMask = kTileSide - 1;
  const int cell =
      (voxel.z() & kMask) << (2 * kShift) | (voxel.y() & kMask) << kShift | (voxel.x() & kMask);
  return root_m_[static_cast<std::size_t>(tile[static_cast<std::size_t>(cell)])];
}

bool DistanceField::take_over(const VoxelMap& map, BlockKey key) {
  const VoxelIndex cell = block_index(key) - first_block_ + VoxelIndex::Constant(halo_);
  if ((cell.array() < 0).any() || (cell.array() >= grid_size_.array()).any()) return false;
  VoxelMask& own = occupied_[static_cast<std::size_t>(
      (cell.z() * grid_size_.y() + cell.y()) * grid_size_.x() + cell.x())];
  const VoxelMask now = obstacles(map.block(key));
  if (own == now) return false;
  own = now;
  return true;
}

void DistanceField::mark_tiles_near(BlockKey key, std::vector<std::uint8_t>& dirty) const {
  const VoxelIndex block = block_index(key) - first_block_;
  VoxelIndex low;
  VoxelIndex high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::max(0, floor_div(block[axis] - halo_, kTileBlocks));
    high[axis] = std::min(tiles_[axis] - 1, floor_div(block[axis] + halo_, kTileBlocks));
  }
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) dirty[tile_number({x, y, z})] = 1;
    }
  }
}

void DistanceField::compute(const std::vector<std::uint8_t>& dirty) {
  const auto stride_y = static_cast<std::size_t>(grid_size_.x());
  const auto stride_z = stride_y * static_cast<std::size_t>(grid_size_.y());
  tbb::enumerable_thread_specific<TileScratch> scratch;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, dirty.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (dirty[i] == 0) continue;
      const auto nx = static_cast<std::size_t>(tiles_.x());
      const auto ny = static_cast<std::size_t>(tiles_.y());
      const std::size_t x = i % nx;
      const std::size_t y = i / nx % ny;
      const std::size_t z = i / nx / ny;
      const std::size_t first = (x + y * stride_y + z * stride_z) * kTileBlocks;
      distance2_[i] =
          tile_distance2({&occupied_[first], stride_y, stride_z, halo_}, reach_, scratch.local());
    }
  });
}

void DistanceField::update(const VoxelMap& map, const std::vector<BlockKey>& changed) {
  CANOPEER_CHECK(map.resolution_m() == resolution_m_, "map and field differ in resolution");
  std::vector<std::uint8_t> dirty(distance2_.size(), 0);
  for (const BlockKey key : changed) {
    if (take_over(map, key)) mark_tiles_near(key, dirty);
  }
  compute(dirty);
}

void DistanceField::rebuild(const VoxelMap& map) {
  CANOPEER_CHECK(map.resolution_m() == resolution_m_, "map and field differ in resolution");
  std::fill(occupied_.begin(), occupied_.end(), obstacles(nullptr));
  for (const BlockKey key : map.block_keys()) take_over(map, key);
  compute(std::vector<std::uint8_t>(distance2_.size(), 1));
}

std::size_t DistanceField::memory_bytes() const {
  std::size_t bytes = occupied_.capacity() * sizeof(VoxelMask) +
                      distance2_.capacity() * sizeof(Tile) + root_m_.capacity() * sizeof(float);
  for (const Tile& tile : distance2_) bytes += tile.capacity() * sizeof(std::int16_t);
  return bytes;
}

}  // namespace canopeer
