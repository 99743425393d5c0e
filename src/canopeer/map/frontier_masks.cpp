#include "canopeer/map/frontier_masks.h"

#include <array>

#include "canopeer/map/kernel_targets.h"

namespace canopeer {
namespace {

using Slice = std::uint64_t;  // 8 × 8 voxels of one z: bit y · 8 + x

constexpr Slice kFirstColumn = 0x0101010101010101;
constexpr Slice kLastColumn = 0x8080808080808080;

// Bits moved by one voxel within a slice; `outer` is the neighbouring block's slice they come from.
Slice from_lower_x(Slice s, Slice outer) {
  return (s << 1 & ~kFirstColumn) | (outer >> 7 & kFirstColumn);
}
Slice from_upper_x(Slice s, Slice outer) {
  return (s >> 1 & ~kLastColumn) | (outer << 7 & kLastColumn);
}
Slice from_lower_y(Slice s, Slice outer) { return s << 8 | outer >> 56; }
Slice from_upper_y(Slice s, Slice outer) { return s >> 8 | outer << 56; }

// A block and the 26 around it.
class Neighbourhood {
 public:
  Neighbourhood(const VoxelMap& map, BlockKey key) : map_(map), centre_(block_index(key)) {
    blocks_.fill(nullptr);
    blocks_[13] = map.block(key);
  }

  // Slice z ∈ [−1, 8] of the block at (dx, dy) beside this one; `Kind` picks the bits.
  template <typename Kind>
  Slice slice(Kind kind, int dx, int dy, int z) {
    const int dz = z < 0 ? -1 : z >= kBlockSide ? 1 : 0;
    return kind(block(dx, dy, dz), static_cast<std::size_t>(z & (kBlockSide - 1)));
  }
  template <typename Kind>
  Slice x_neighbours(Kind kind, int dy, int z) {
    const Slice s = slice(kind, 0, dy, z);
    return from_lower_x(s, slice(kind, -1, dy, z)) | from_upper_x(s, slice(kind, 1, dy, z));
  }
  template <typename Kind>
  Slice y_neighbours(Kind kind, int z) {
    const Slice s = slice(kind, 0, 0, z);
    return from_lower_y(s, slice(kind, 0, -1, z)) | from_upper_y(s, slice(kind, 0, 1, z));
  }
  template <typename Kind>
  Slice xy_neighbours(Kind kind, int z) {
    const Slice s = x_neighbours(kind, 0, z);
    return from_lower_y(s, x_neighbours(kind, -1, z)) | from_upper_y(s, x_neighbours(kind, 1, z));
  }
  // The voxels of slice z with a 6- or 18-neighbour of the kind.
  template <typename Kind>
  Slice near6(Kind kind, int z) {
    return x_neighbours(kind, 0, z) | y_neighbours(kind, z) | slice(kind, 0, 0, z - 1) |
           slice(kind, 0, 0, z + 1);
  }
  template <typename Kind>
  Slice near18(Kind kind, int z) {
    Slice sum = near6(kind, z) | xy_neighbours(kind, z);
    for (const int dz : {-1, 1}) sum |= x_neighbours(kind, 0, z + dz) | y_neighbours(kind, z + dz);
    return sum;
  }
  // (0, 0, 0) is the block itself.
  const BlockMasks& block(int dx, int dy, int dz) {
    static const BlockMasks kUnknown{};
    const BlockMasks*& found = blocks_[static_cast<std::size_t>(13 + dx + 3 * dy + 9 * dz)];
    if (found == nullptr) {
      found = map_.block(pack_block(centre_.x() + dx, centre_.y() + dy, centre_.z() + dz));
      if (found == nullptr) found = &kUnknown;
    }
    return *found;
  }

 private:
  const VoxelMap& map_;
  VoxelIndex centre_;
  std::array<const BlockMasks*, 27> blocks_;
};

// Slices −1 … 8 of a column of blocks, and the same of the four columns beside it.
struct Cross {
  std::array<Slice, kBlockSide + 2> centre;
  std::array<Slice, kBlockSide> lower_x, upper_x, lower_y, upper_y;
};

// The voxels of the middle block with a 6-neighbour in the cross.
CANOPEER_KERNEL_BODY void near6_body(const Cross& cross, Slice* near) {
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const Slice s = cross.centre[z + 1];
    near[z] = from_lower_x(s, cross.lower_x[z]) | from_upper_x(s, cross.upper_x[z]) |
              from_lower_y(s, cross.lower_y[z]) | from_upper_y(s, cross.upper_y[z]) |
              cross.centre[z] | cross.centre[z + 2];
  }
}
void near6_scalar(const Cross& cross, Slice* near) { near6_body(cross, near); }
CANOPEER_TARGET_AVX2 void near6_avx2(const Cross& cross, Slice* near) { near6_body(cross, near); }
CANOPEER_TARGET_AVX512 void near6_avx512(const Cross& cross, Slice* near) {
  near6_body(cross, near);
}

// `Kind` picks the bits of a block's slice.
template <typename Kind>
void gather(Neighbourhood& around, Kind kind, Cross& cross) {
  cross.centre[0] = around.slice(kind, 0, 0, -1);
  cross.centre[kBlockSide + 1] = around.slice(kind, 0, 0, kBlockSide);
  const auto copy = [&](int dx, int dy, Slice* out) {
    const BlockMasks& block = around.block(dx, dy, 0);
    for (std::size_t z = 0; z < kBlockSide; ++z) out[z] = kind(block, z);
  };
  copy(0, 0, &cross.centre[1]);
  copy(-1, 0, cross.lower_x.data());
  copy(1, 0, cross.upper_x.data());
  copy(0, -1, cross.lower_y.data());
  copy(0, 1, cross.upper_y.data());
}

}  // namespace

FrontierMasks frontier_masks(const VoxelMap& map, BlockKey key, bool near_roi, SimdLevel simd) {
  const auto unknown = [](const BlockMasks& b, std::size_t z) { return ~b.observed.slices[z]; };
  const auto occupied = [](const BlockMasks& b, std::size_t z) { return b.occupied.slices[z]; };
  const auto roi = [](const BlockMasks& b, std::size_t z) { return b.roi.slices[z]; };
  const auto near6 = simd == SimdLevel::avx512 ? near6_avx512
                     : simd == SimdLevel::avx2 ? near6_avx2
                                               : near6_scalar;
  FrontierMasks masks;
  const BlockMasks& block = *map.block(key);
  VoxelMask free = block.observed;
  free -= block.occupied;
  if (!free.any()) return masks;
  Neighbourhood around(map, key);
  Cross cross;
  gather(around, unknown, cross);
  VoxelMask open;
  near6(cross, open.slices.data());
  open &= free;
  if (open.any()) {
    gather(around, occupied, cross);
    VoxelMask beside_occupied;
    near6(cross, beside_occupied.slices.data());
    masks.occupied = masks.border = open;
    masks.occupied &= beside_occupied;
    masks.border -= beside_occupied;
  }
  if (!near_roi) return masks;
  for (int z = 0; z < kBlockSide; ++z) {
    const auto i = static_cast<std::size_t>(z);
    if (free.slices[i] == 0) continue;
    const Slice beside_roi = free.slices[i] & around.near18(roi, z);
    if (beside_roi != 0) masks.roi.slices[i] = beside_roi & around.near18(unknown, z);
  }
  return masks;
}

}  // namespace canopeer
