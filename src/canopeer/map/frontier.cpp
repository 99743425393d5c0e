#include "canopeer/map/frontier.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "canopeer/map/block_surroundings.h"
#include "canopeer/map/voxel_bounds.h"

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

 private:
  const BlockMasks& block(int dx, int dy, int dz) {
    static const BlockMasks kUnknown{};
    const BlockMasks*& found = blocks_[static_cast<std::size_t>(13 + dx + 3 * dy + 9 * dz)];
    if (found == nullptr) {
      found = map_.block(pack_block(centre_.x() + dx, centre_.y() + dy, centre_.z() + dz));
      if (found == nullptr) found = &kUnknown;
    }
    return *found;
  }

  const VoxelMap& map_;
  VoxelIndex centre_;
  std::array<const BlockMasks*, 27> blocks_;
};

struct BlockTargets {
  VoxelMask roi, occupied, border;
};

BlockTargets targets_of(const VoxelMap& map, BlockKey key, bool near_roi) {
  const auto unknown = [](const BlockMasks& b, std::size_t z) { return ~b.observed.slices[z]; };
  const auto occupied = [](const BlockMasks& b, std::size_t z) { return b.occupied.slices[z]; };
  const auto roi = [](const BlockMasks& b, std::size_t z) { return b.roi.slices[z]; };
  BlockTargets targets;
  const BlockMasks& block = *map.block(key);
  Neighbourhood around(map, key);
  for (int z = 0; z < kBlockSide; ++z) {
    const auto i = static_cast<std::size_t>(z);
    const Slice free = block.observed.slices[i] & ~block.occupied.slices[i];
    if (free == 0) continue;
    if (const Slice open = free & around.near6(unknown, z); open != 0) {
      const Slice beside_occupied = around.near6(occupied, z);
      targets.occupied.slices[i] = open & beside_occupied;
      targets.border.slices[i] = open & ~beside_occupied;
    }
    if (!near_roi) continue;
    targets.roi.slices[i] = free & around.near18(roi, z) & around.near18(unknown, z);
  }
  return targets;
}

}  // namespace

FrontierTargets extract_frontiers(const VoxelMap& map, const Box& world) {
  const VoxelBounds bounds = VoxelBounds::inside(world, map.resolution_m());
  const std::vector<BlockKey> keys = map.block_keys(world);
  if (keys.empty()) return {};
  const BlockSurroundings around(map, keys);
  std::vector<BlockTargets> found(keys.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 128), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (around.has_unknown(keys[i])) found[i] = targets_of(map, keys[i], around.has_roi(keys[i]));
    }
  });
  FrontierTargets targets;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const VoxelMask inside = bounds.mask(keys[i]);
    const auto collect = [&](VoxelMask mask, std::vector<VoxelIndex>& out) {
      for_each_voxel(keys[i], mask &= inside, [&](const VoxelIndex& v) { out.push_back(v); });
    };
    collect(found[i].roi, targets.roi);
    collect(found[i].occupied, targets.occupied);
    collect(found[i].border, targets.border);
  }
  return targets;
}

}  // namespace canopeer
