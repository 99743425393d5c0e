#include "canopeer/map/distance_field.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "canopeer/base/check.h"
#include "canopeer/map/distances/distance_tile.h"
#include "canopeer/map/storage/voxel_bounds.h"

namespace canopeer {
namespace {

constexpr int kMaxReach = 120;  // 2 · reach² must fit 16 bits

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

DistanceField::DistanceField(const DistanceFieldOptions& options, double resolution_m)
    : world_(options.world),
      resolution_m_(resolution_m),
      truncation_m_(options.truncation_m),
      to_(options.to),
      assumed_free_(options.assumed_free) {
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
  occupied_.resize(volume(grid_size_));
  distance2_.resize(volume(tiles_));
  for (int d2 = 0; d2 <= reach_ * reach_; ++d2) {
    root_m_.push_back(static_cast<float>(std::min(std::sqrt(d2) * resolution_m_, truncation_m_)));
  }
  forget();
  // Nothing is known yet, and that may be what distances are to.
  if (to_ == DistanceTo::occupied_or_unknown) {
    compute(std::vector<std::uint8_t>(distance2_.size(), 1));
  }
}

void DistanceField::forget() {
  const VoxelIndex shift = first_block_ - VoxelIndex::Constant(halo_);
  VoxelIndex cell;
  for (cell.z() = 0; cell.z() < grid_size_.z(); ++cell.z()) {
    for (cell.y() = 0; cell.y() < grid_size_.y(); ++cell.y()) {
      for (cell.x() = 0; cell.x() < grid_size_.x(); ++cell.x()) {
        const VoxelIndex block = cell + shift;
        occupied_[cell_number(cell)] =
            obstacles(pack_block(block.x(), block.y(), block.z()), nullptr);
      }
    }
  }
}

VoxelMask DistanceField::obstacles(BlockKey key, const BlockMasks* block) const {
  if (to_ == DistanceTo::roi) return block != nullptr ? block->roi : VoxelMask{};
  VoxelMask mask;
  if (to_ == DistanceTo::occupied_or_unknown) {
    mask = VoxelMask::all();
    if (block != nullptr) mask -= block->observed;
    if (!assumed_free_.isEmpty() && mask.any()) {
      VoxelMask free;
      for_each_voxel(key, mask, [&](const VoxelIndex& voxel) {
        if (assumed_free_.contains(voxel_centre(voxel, resolution_m_))) free.set(voxel);
      });
      mask -= free;
    }
  }
  if (block != nullptr) mask |= block->occupied;
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
  std::uint16_t distance2 = 0;
  if (tile_cell_bytes(reach_) == 1) {
    distance2 = tile[static_cast<std::size_t>(cell)];
  } else {
    std::memcpy(&distance2, &tile[2 * static_cast<std::size_t>(cell)], sizeof distance2);
  }
  return root_m_[distance2];
}

VoxelMask DistanceField::take_over(const VoxelMap& map, BlockKey key) {
  const VoxelIndex cell = block_index(key) - first_block_ + VoxelIndex::Constant(halo_);
  if ((cell.array() < 0).any() || (cell.array() >= grid_size_.array()).any()) return {};
  VoxelMask& own = occupied_[cell_number(cell)];
  const VoxelMask now = obstacles(key, map.block(key));
  VoxelMask moved;
  for (std::size_t z = 0; z < kBlockSide; ++z) moved.slices[z] = own.slices[z] ^ now.slices[z];
  own = now;
  return moved;
}

void DistanceField::mark_tiles_near(BlockKey key, const VoxelMask& moved,
                                    std::vector<std::uint8_t>& dirty) const {
  const VoxelBounds within = VoxelBounds::of(moved);
  const VoxelIndex origin = (block_index(key) - first_block_) * kBlockSide;
  VoxelIndex low;
  VoxelIndex high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::max(0, floor_div(origin[axis] + within.first[axis] - reach_, kTileSide));
    high[axis] =
        std::min(tiles_[axis] - 1, floor_div(origin[axis] + within.last[axis] + reach_, kTileSide));
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
      tile_distance2({&occupied_[first], stride_y, stride_z, halo_}, reach_, scratch.local(),
                     distance2_[i]);
    }
  });
}

void DistanceField::update(const VoxelMap& map, const std::vector<BlockKey>& changed) {
  CANOPEER_CHECK(map.resolution_m() == resolution_m_, "map and field differ in resolution");
  std::vector<std::uint8_t> dirty(distance2_.size(), 0);
  for (const BlockKey key : changed) {
    const VoxelMask moved = take_over(map, key);
    if (moved.any()) mark_tiles_near(key, moved, dirty);
  }
  compute(dirty);
}

void DistanceField::rebuild(const VoxelMap& map) {
  CANOPEER_CHECK(map.resolution_m() == resolution_m_, "map and field differ in resolution");
  forget();
  for (const BlockKey key : map.block_keys()) take_over(map, key);
  compute(std::vector<std::uint8_t>(distance2_.size(), 1));
}

std::size_t DistanceField::memory_bytes() const {
  std::size_t bytes = occupied_.capacity() * sizeof(VoxelMask) +
                      distance2_.capacity() * sizeof(Tile) + root_m_.capacity() * sizeof(float);
  for (const Tile& tile : distance2_) bytes += tile.capacity();
  return bytes;
}

}  // namespace canopeer
