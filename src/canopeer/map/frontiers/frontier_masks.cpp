#include "canopeer/map/frontiers/frontier_masks.h"

#include <array>

#include "canopeer/map/storage/kernel_targets.h"

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

// Slices −1 … 8 of a column of blocks.
using Column = std::array<Slice, kBlockSide + 2>;
// The nine columns around a block: [dy + 1][dx + 1].
using Columns = std::array<std::array<Column, 3>, 3>;

// The voxels of the middle block with a 6-neighbour.
CANOPEER_KERNEL_BODY void near6_body(const Columns& columns, Slice* near) {
  const Column& centre = columns[1][1];
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const Slice s = centre[z + 1];
    near[z] = from_lower_x(s, columns[1][0][z + 1]) | from_upper_x(s, columns[1][2][z + 1]) |
              from_lower_y(s, columns[0][1][z + 1]) | from_upper_y(s, columns[2][1][z + 1]) |
              centre[z] | centre[z + 2];
  }
}

// Those with an 18-neighbour.
CANOPEER_KERNEL_BODY void near18_body(const Columns& columns, Slice* near) {
  Column beside_x[3], beside, diagonal;
  for (std::size_t y = 0; y < 3; ++y) {
    for (std::size_t z = 0; z < beside.size(); ++z) {
      const Slice s = columns[y][1][z];
      beside_x[y][z] = from_lower_x(s, columns[y][0][z]) | from_upper_x(s, columns[y][2][z]);
    }
  }
  for (std::size_t z = 0; z < beside.size(); ++z) {
    const Slice s = columns[1][1][z], x = beside_x[1][z];
    beside[z] = x | from_lower_y(s, columns[0][1][z]) | from_upper_y(s, columns[2][1][z]);
    diagonal[z] = from_lower_y(x, beside_x[0][z]) | from_upper_y(x, beside_x[2][z]);
  }
  const Column& centre = columns[1][1];
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    near[z] =
        beside[z] | beside[z + 1] | beside[z + 2] | diagonal[z + 1] | centre[z] | centre[z + 2];
  }
}

struct NearKernels {
  void (*near6)(const Columns& columns, Slice* near);
  void (*near18)(const Columns& columns, Slice* near);
};

#define CANOPEER_KERNELS(NAME, TARGET)                                                           \
  TARGET void near6_##NAME(const Columns& columns, Slice* near) { near6_body(columns, near); }   \
  TARGET void near18_##NAME(const Columns& columns, Slice* near) { near18_body(columns, near); } \
  constexpr NearKernels kNear_##NAME = {near6_##NAME, near18_##NAME};

CANOPEER_EACH_LEVEL(CANOPEER_KERNELS)

// `Kind` picks the bits of a block's slice.
template <typename Kind>
void gather_column(Neighbourhood& around, Kind kind, int dx, int dy, Columns& columns) {
  Column& column = columns[static_cast<std::size_t>(dy + 1)][static_cast<std::size_t>(dx + 1)];
  const BlockMasks& block = around.block(dx, dy, 0);
  for (std::size_t z = 0; z < kBlockSide; ++z) column[z + 1] = kind(block, z);
}

// What near6 wants.
template <typename Kind>
void gather_cross(Neighbourhood& around, Kind kind, Columns& columns) {
  columns[1][1].front() = kind(around.block(0, 0, -1), kBlockSide - 1);
  columns[1][1].back() = kind(around.block(0, 0, 1), 0);
  gather_column(around, kind, 0, 0, columns);
  for (const int d : {-1, 1}) {
    gather_column(around, kind, d, 0, columns);
    gather_column(around, kind, 0, d, columns);
  }
}

// What near18 wants.
template <typename Kind>
void gather_all(Neighbourhood& around, Kind kind, Columns& columns) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      gather_column(around, kind, dx, dy, columns);
      Column& column = columns[static_cast<std::size_t>(dy + 1)][static_cast<std::size_t>(dx + 1)];
      column.front() = kind(around.block(dx, dy, -1), kBlockSide - 1);
      column.back() = kind(around.block(dx, dy, 1), 0);
    }
  }
}

}  // namespace

FrontierMasks frontier_masks(const VoxelMap& map, BlockKey key, bool near_roi,
                             [[maybe_unused]] SimdLevel simd) {
  const auto unknown = [](const BlockMasks& b, std::size_t z) { return ~b.observed.slices[z]; };
  const auto occupied = [](const BlockMasks& b, std::size_t z) { return b.occupied.slices[z]; };
  const auto roi = [](const BlockMasks& b, std::size_t z) { return b.roi.slices[z]; };
  const NearKernels& kernels = CANOPEER_AT_LEVEL(simd, kNear);
  FrontierMasks masks;
  const BlockMasks& block = *map.block(key);
  VoxelMask free = block.observed;
  free -= block.occupied;
  if (!free.any()) return masks;
  Neighbourhood around(map, key);
  Columns columns;
  gather_cross(around, unknown, columns);
  VoxelMask open;
  kernels.near6(columns, open.slices.data());
  open &= free;
  if (open.any()) {
    gather_cross(around, occupied, columns);
    VoxelMask beside_occupied;
    kernels.near6(columns, beside_occupied.slices.data());
    masks.occupied = masks.border = open;
    masks.occupied &= beside_occupied;
    masks.border -= beside_occupied;
  }
  if (!near_roi) return masks;
  gather_all(around, roi, columns);
  kernels.near18(columns, masks.roi.slices.data());
  masks.roi &= free;
  if (!masks.roi.any()) return masks;
  gather_all(around, unknown, columns);
  VoxelMask beside_unknown;
  kernels.near18(columns, beside_unknown.slices.data());
  masks.roi &= beside_unknown;
  return masks;
}

}  // namespace canopeer
