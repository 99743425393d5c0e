#include "canopeer/map/frontier_index.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "canopeer/base/check.h"
#include "canopeer/map/frontiers/block_surroundings.h"
#include "canopeer/map/frontiers/frontier_lists.h"
#include "canopeer/map/storage/voxel_bounds.h"

namespace canopeer {

FrontierIndex::FrontierIndex(const Box& world, double resolution_m)
    : world_(world), resolution_m_(resolution_m) {
  const VoxelBounds bounds = VoxelBounds::inside(world, resolution_m);
  if (bounds.empty()) return;
  first_ = block_index(block_key(bounds.first));
  size_ = block_index(block_key(bounds.last)) - first_ + VoxelIndex::Ones();
  CANOPEER_CHECK(size_.cast<double>().prod() < 1e8, "a frontier index needs a bounded box");
  for (int z = 0; z < size_.z(); ++z) {
    for (int y = 0; y < size_.y(); ++y) {
      for (int x = 0; x < size_.x(); ++x) {
        keys_.push_back(pack_block(first_.x() + x, first_.y() + y, first_.z() + z));
      }
    }
  }
  masks_.resize(keys_.size());
}

std::ptrdiff_t FrontierIndex::place(const VoxelIndex& block) const {
  const VoxelIndex at = block - first_;
  if ((at.array() < 0).any() || (at.array() >= size_.array()).any()) return -1;
  return (static_cast<std::ptrdiff_t>(at.z()) * size_.y() + at.y()) * size_.x() + at.x();
}

void FrontierIndex::compute(const VoxelMap& map, const std::vector<BlockKey>& keys) {
  if (keys.empty()) return;
  const VoxelBounds bounds = VoxelBounds::inside(world_, resolution_m_);
  const SimdLevel simd = best_simd_level();
  const BlockSurroundings around(map, keys);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 128), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      FrontierMasks found;
      if (around.has_unknown(keys[i])) {
        found = frontier_masks(map, keys[i], around.has_roi(keys[i]), simd);
        const VoxelMask inside = bounds.mask(keys[i]);
        found.roi &= inside;
        found.occupied &= inside;
        found.border &= inside;
      }
      masks_[static_cast<std::size_t>(place(block_index(keys[i])))] = found;
    }
  });
}

void FrontierIndex::update(const VoxelMap& map, const std::vector<BlockKey>& changed) {
  CANOPEER_CHECK(map.resolution_m() == resolution_m_, "map and index differ in resolution");
  if (keys_.empty()) return;
  // With a block more on each side: changes beside the box count, too.
  const VoxelIndex size = size_ + VoxelIndex::Constant(2);
  const auto row = static_cast<std::size_t>(size.x());
  const std::size_t layer = row * static_cast<std::size_t>(size.y());
  std::vector<std::uint8_t> stale(layer * static_cast<std::size_t>(size.z()), 0);
  for (const BlockKey key : changed) {
    const VoxelIndex at = block_index(key) - first_ + VoxelIndex::Ones();
    if ((at.array() < 0).any() || (at.array() >= size.array()).any()) continue;
    stale[at.z() * layer + at.y() * row + at.x()] = 1;
  }
  for (const std::size_t stride : {std::size_t{1}, row, layer}) spread_flags(stride, stale);
  std::vector<BlockKey> keys;
  const BlockKey* key = keys_.data();
  for (int z = 1; z <= size_.z(); ++z) {
    for (int y = 1; y <= size_.y(); ++y) {
      const std::uint8_t* flags = &stale[z * layer + y * row + 1];
      for (int x = 0; x < size_.x(); ++x, ++key) {
        if (flags[x] != 0 && map.block(*key) != nullptr) keys.push_back(*key);
      }
    }
  }
  compute(map, keys);
}

void FrontierIndex::rebuild(const VoxelMap& map) {
  CANOPEER_CHECK(map.resolution_m() == resolution_m_, "map and index differ in resolution");
  std::fill(masks_.begin(), masks_.end(), FrontierMasks{});
  compute(map, map.block_keys(world_));
}

FrontierTargets FrontierIndex::targets() const { return frontier_lists(keys_, masks_); }

}  // namespace canopeer
