#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// What distances are measured to.
enum class DistanceTo {
  occupied,
  occupied_or_unknown,  ///< for motions that may not enter what was never seen
  roi,
};

/// To what distances are measured, where, and how far.
struct DistanceFieldOptions {
  Box world;                   ///< where distances are wanted; not empty
  double truncation_m = 0.15;  ///< larger distances are reported as this; at most 120 voxels
  DistanceTo to = DistanceTo::occupied;
  /// Where unknown voxels count as free after all (their centres in here); empty: nowhere.
  Box assumed_free{};
};

/// Truncated distance to the nearest occupied voxel (or what DistanceTo says), for the many
/// collision checks of planning. Squared distances in voxels are exact. They come from separable
/// min-plus passes (Felzenszwalb & Huttenlocher 2012, here truncated) over tiles of 32³ voxels.
/// Only tiles within reach of a change are computed again. Const calls are thread-safe; a copy is a
/// snapshot.
class DistanceField {
 public:
  DistanceField(const DistanceFieldOptions& options, double resolution_m);

  /// Takes over the blocks in `changed`; the map's resolution must be the field's. The result is
  /// that of rebuild() when every block that changed since the last call is in `changed`.
  void update(const VoxelMap& map, const std::vector<BlockKey>& changed);
  void rebuild(const VoxelMap& map);

  /// A lower bound on the distance (m) from p to the nearest occupied voxel (a cube), or what
  /// DistanceTo says. It is less than one voxel diagonal below that distance, and never more than
  /// truncation_m(). Outside world(), where nothing is known: truncation_m().
  [[nodiscard]] float distance(const Vec3& p_world) const;
  [[nodiscard]] double truncation_m() const { return truncation_m_; }
  [[nodiscard]] double resolution_m() const { return resolution_m_; }

  /// `visit(VoxelIndex)` for the occupied voxels (in the sense above) that overlap `box_world`, as
  /// far as the field knows of them: within truncation_m() around world().
  template <typename Visit>
  void for_each_occupied(const Box& box_world, Visit&& visit) const;

  [[nodiscard]] const Box& world() const { return world_; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  using Tile = std::vector<std::uint8_t>;  // of tile_distance2(); empty: nothing within reach

  /// What distances are to in a block; `block`: null when never observed.
  [[nodiscard]] VoxelMask obstacles(BlockKey key, const BlockMasks* block) const;
  /// To the state in which no block was ever observed.
  void forget();
  [[nodiscard]] std::size_t tile_number(const VoxelIndex& tile) const;
  /// Copies the block's mask; returns what is new in it, nothing when it is out of reach.
  VoxelMask take_over(const VoxelMap& map, BlockKey key);
  /// The tiles within reach of the voxels `moved` of a block.
  void mark_tiles_near(BlockKey key, const VoxelMask& moved,
                       std::vector<std::uint8_t>& dirty) const;
  void compute(const std::vector<std::uint8_t>& dirty);

  [[nodiscard]] std::size_t cell_number(const VoxelIndex& cell) const {
    return static_cast<std::size_t>((cell.z() * grid_size_.y() + cell.y()) * grid_size_.x() +
                                    cell.x());
  }

  Box world_;
  double resolution_m_;
  double truncation_m_;
  DistanceTo to_;
  Box assumed_free_;
  int reach_;                        // truncation in voxels
  int halo_;                         // blocks beside a tile that are within its reach
  VoxelIndex first_block_;           // of tile (0, 0, 0)
  VoxelIndex tiles_;                 // number of tiles per axis
  VoxelIndex grid_size_;             // blocks per axis of occupied_, halo included
  std::vector<VoxelMask> occupied_;  // dense copy of the map's masks
  std::vector<Tile> distance2_;      // squared, in voxels
  std::vector<float> root_m_;        // squared distance in voxels → metres
};

template <typename Visit>
void DistanceField::for_each_occupied(const Box& box_world, Visit&& visit) const {
  const VoxelIndex low = voxel_at(box_world.min(), resolution_m_);
  const VoxelIndex high = voxel_at(box_world.max(), resolution_m_);
  const VoxelIndex shift = first_block_ - VoxelIndex::Constant(halo_);  // of the grid's first block
  const auto block_of = [](int voxel) { return voxel >> kBlockShift; };
  const VoxelIndex first = (low.unaryExpr(block_of) - shift).cwiseMax(0);
  const VoxelIndex last =
      (high.unaryExpr(block_of) - shift).cwiseMin(grid_size_ - VoxelIndex::Ones());
  VoxelIndex cell;
  for (cell.z() = first.z(); cell.z() <= last.z(); ++cell.z()) {
    for (cell.y() = first.y(); cell.y() <= last.y(); ++cell.y()) {
      for (cell.x() = first.x(); cell.x() <= last.x(); ++cell.x()) {
        const VoxelMask& mask = occupied_[cell_number(cell)];
        const VoxelIndex origin = (cell + shift) * kBlockSide;
        const VoxelIndex from = (low - origin).cwiseMax(0);
        const VoxelIndex to = (high - origin).cwiseMin(kBlockSide - 1);
        // Bits of the rows and columns asked for, the same in every slice.
        const std::uint64_t columns = (0xFFU >> (7 - to.x())) & (0xFFU << from.x());
        std::uint64_t wanted = 0;
        for (int y = from.y(); y <= to.y(); ++y) wanted |= columns << (y << kBlockShift);
        for (int z = from.z(); z <= to.z(); ++z) {
          for (std::uint64_t bits = mask.slices[static_cast<std::size_t>(z)] & wanted; bits != 0;
               bits &= bits - 1) {
            const int bit = std::countr_zero(bits);
            visit(VoxelIndex(origin + VoxelIndex(bit & (kBlockSide - 1), bit >> kBlockShift, z)));
          }
        }
      }
    }
  }
}

}  // namespace canopeer
