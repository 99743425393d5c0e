#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

/// The map is made of blocks of 8 × 8 × 8 voxels. A key packs the block's three indices (21 bits
/// each, offset binary), so keys sort by z, then y, then x, negative indices included.
using BlockKey = std::uint64_t;

inline constexpr int kBlockShift = 3;
inline constexpr int kBlockSide = 1 << kBlockShift;
inline constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;
/// Block indices lie in [−kBlockIndexLimit, kBlockIndexLimit): ± 84 km at 1 cm.
inline constexpr int kBlockIndexLimit = 1 << 20;

/// Key of the block with index (bx, by, bz).
inline BlockKey pack_block(int bx, int by, int bz) {
  const auto field = [](int b) { return static_cast<std::uint64_t>(b + kBlockIndexLimit); };
  return field(bz) << 42 | field(by) << 21 | field(bx);
}

/// Key of the block that holds `voxel`.
inline BlockKey block_key(const VoxelIndex& voxel) {
  return pack_block(voxel.x() >> kBlockShift, voxel.y() >> kBlockShift, voxel.z() >> kBlockShift);
}

/// Index of the block (not of a voxel).
inline VoxelIndex block_index(BlockKey key) {
  const auto field = [key](int shift) {
    return static_cast<int>(key >> shift & 0x1FFFFF) - kBlockIndexLimit;
  };
  return {field(0), field(21), field(42)};
}

/// The block's voxel with the lowest indices.
inline VoxelIndex block_origin(BlockKey key) { return block_index(key) * kBlockSide; }

/// Place of a voxel among its block's, x fastest.
inline std::size_t voxel_offset(const VoxelIndex& voxel) {
  constexpr int kMask = kBlockSide - 1;
  return static_cast<std::size_t>((voxel.z() & kMask) << (2 * kBlockShift) |
                                  (voxel.y() & kMask) << kBlockShift | (voxel.x() & kMask));
}

/// One bit per voxel of a block: slice z, bit y · 8 + x.
struct VoxelMask {
  std::array<std::uint64_t, kBlockSide> slices{};

  static int slice_of(const VoxelIndex& voxel) { return voxel.z() & (kBlockSide - 1); }
  static std::uint64_t bit_of(const VoxelIndex& voxel) {
    return std::uint64_t{1} << ((voxel.y() & (kBlockSide - 1)) << kBlockShift |
                                (voxel.x() & (kBlockSide - 1)));
  }
  static constexpr VoxelMask all() {
    VoxelMask mask;
    for (std::uint64_t& slice : mask.slices) slice = ~std::uint64_t{0};
    return mask;
  }

  /// `voxel` may be any voxel of the map; only its place within its block counts.
  bool test(const VoxelIndex& voxel) const {
    return (slices[static_cast<std::size_t>(slice_of(voxel))] & bit_of(voxel)) != 0;
  }
  void set(const VoxelIndex& voxel) {
    slices[static_cast<std::size_t>(slice_of(voxel))] |= bit_of(voxel);
  }
  bool any() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t slice : slices) sum |= slice;
    return sum != 0;
  }
  bool full() const {
    std::uint64_t product = ~std::uint64_t{0};
    for (const std::uint64_t slice : slices) product &= slice;
    return product == ~std::uint64_t{0};
  }
  int count() const {
    int sum = 0;
    for (const std::uint64_t slice : slices) sum += std::popcount(slice);
    return sum;
  }
  VoxelMask& operator|=(const VoxelMask& other) {
    for (std::size_t z = 0; z < kBlockSide; ++z) slices[z] |= other.slices[z];
    return *this;
  }
  VoxelMask& operator&=(const VoxelMask& other) {
    for (std::size_t z = 0; z < kBlockSide; ++z) slices[z] &= other.slices[z];
    return *this;
  }
  /// Removes the voxels of `other`.
  VoxelMask& operator-=(const VoxelMask& other) {
    for (std::size_t z = 0; z < kBlockSide; ++z) slices[z] &= ~other.slices[z];
    return *this;
  }
  friend bool operator==(const VoxelMask& a, const VoxelMask& b) { return a.slices == b.slices; }
};

/// Calls `visit(VoxelIndex)` for the set voxels of block `key`, in the order z, y, x.
template <typename Visit>
void for_each_voxel(BlockKey key, const VoxelMask& mask, Visit&& visit) {
  const VoxelIndex origin = block_origin(key);
  for (int z = 0; z < kBlockSide; ++z) {
    for (std::uint64_t bits = mask.slices[static_cast<std::size_t>(z)]; bits != 0;
         bits &= bits - 1) {
      const int bit = std::countr_zero(bits);
      visit(VoxelIndex(origin + VoxelIndex(bit & (kBlockSide - 1), bit >> kBlockShift, z)));
    }
  }
}

}  // namespace canopeer
