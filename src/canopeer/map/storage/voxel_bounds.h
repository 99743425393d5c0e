#pragma once

#include <algorithm>
#include <cmath>

#include "canopeer/map/storage/block.h"

namespace canopeer {

/// The voxels whose centres lie in a box: indices first … last on each axis, both included; none
/// when last < first on an axis.
struct VoxelBounds {
  VoxelIndex first;
  VoxelIndex last;

  /// `world` may be unbounded or empty.
  static VoxelBounds inside(const Box& world, double resolution_m) {
    constexpr double kLimit = kBlockSide * (kBlockIndexLimit - 2.0);
    const auto index = [](double v) {
      return static_cast<int>(v < -kLimit ? -kLimit : v > kLimit ? kLimit : v);
    };
    VoxelBounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.first[axis] = index(std::ceil(world.min()[axis] / resolution_m - 0.5));
      bounds.last[axis] = index(std::floor(world.max()[axis] / resolution_m - 0.5));
    }
    return bounds;
  }

  /// Around the voxels of a mask (not empty), counted from their block's first.
  static VoxelBounds of(const VoxelMask& mask) {
    std::uint64_t above = 0;  // what the slices hold together, seen along z
    VoxelBounds bounds{VoxelIndex::Constant(kBlockSide), VoxelIndex::Zero()};
    for (int z = 0; z < kBlockSide; ++z) {
      const std::uint64_t slice = mask.slices[static_cast<std::size_t>(z)];
      if (slice == 0) continue;
      above |= slice;
      bounds.first.z() = std::min(bounds.first.z(), z);
      bounds.last.z() = z;
    }
    bounds.first.y() = std::countr_zero(above) / kBlockSide;
    bounds.last.y() = (63 - std::countl_zero(above)) / kBlockSide;
    for (int shift = 32; shift >= kBlockSide; shift /= 2) above |= above >> shift;
    const auto row = static_cast<std::uint8_t>(above);
    bounds.first.x() = std::countr_zero(row);
    bounds.last.x() = 7 - std::countl_zero(row);
    return bounds;
  }

  [[nodiscard]] bool empty() const { return (last.array() < first.array()).any(); }
  [[nodiscard]] bool contains(const VoxelIndex& v) const {
    return (v.array() >= first.array()).all() && (v.array() <= last.array()).all();
  }
  [[nodiscard]] bool overlaps_block(BlockKey key) const {
    const VoxelIndex origin = block_origin(key);
    return ((origin.array() + (kBlockSide - 1)) >= first.array()).all() &&
           (origin.array() <= last.array()).all();
  }
  /// The block's voxels within the bounds.
  [[nodiscard]] VoxelMask mask(BlockKey key) const {
    const VoxelIndex origin = block_origin(key);
    const VoxelIndex low = (first - origin).cwiseMax(0);
    const VoxelIndex high = (last - origin).cwiseMin(kBlockSide - 1);
    VoxelMask mask;
    if ((low.array() > high.array()).any()) return mask;
    const std::uint64_t row = (0xFFU >> (kBlockSide - 1 - high.x())) & (0xFFU << low.x());
    std::uint64_t slice = 0;
    for (int y = low.y(); y <= high.y(); ++y) slice |= row << (y << kBlockShift);
    for (int z = low.z(); z <= high.z(); ++z) mask.slices[static_cast<std::size_t>(z)] = slice;
    return mask;
  }
};

}  // namespace canopeer
