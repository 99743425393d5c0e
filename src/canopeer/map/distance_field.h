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

struct DistanceFieldOptions {
  Box world;                   ///< where distances are wanted; not empty
  double truncation_m = 0.15;  ///< larger distances are reported as this; at most 120 voxels
  DistanceTo to = DistanceTo::occupied;
};

/// Truncated distance to the nearest occupied voxel (or what DistanceTo says), for the many
/// collision checks of planning.
/// Exact squared distances in voxels by separable min-plus passes (Felzenszwalb & Huttenlocher
/// 2012, here truncated) over tiles of 32³ voxels; only tiles within reach of a change are
/// computed again. Const calls are thread-safe; a copy is a snapshot.
class DistanceField {
 public:
  DistanceField(const DistanceFieldOptions& options, double resolution_m);

  /// Takes over the blocks in `changed`; the map's resolution must be the field's. The result is
  /// that of rebuild() when every block that changed since the last call is in `changed`.
  void update(const VoxelMap& map, const std::vector<BlockKey>& changed);
  void rebuild(const VoxelMap& map);

  /// A lower bound on the distance (m) from p to the nearest occupied voxel (a cube), less than
  /// one voxel diagonal below it; never more than truncation_m(). Outside world(), where nothing
  /// is known: truncation_m().
  [[nodiscard]] float distance(const Vec3& p_world) const;
  [[nodiscard]] double truncation_m() const { return truncation_m_; }
  [[nodiscard]] const Box& world() const { return world_; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  using Tile = std::vector<std::int16_t>;  // empty: nothing within reach

  [[nodiscard]] VoxelMask obstacles(const BlockMasks* block) const;
  [[nodiscard]] std::size_t tile_number(const VoxelIndex& tile) const;
  /// Copies the block's mask; false: nothing new, or out of reach.
  bool take_over(const VoxelMap& map, BlockKey key);
  void mark_tiles_near(BlockKey key, std::vector<std::uint8_t>& dirty) const;
  void compute(const std::vector<std::uint8_t>& dirty);

  Box world_;
  double resolution_m_;
  double truncation_m_;
  DistanceTo to_;
  int reach_;                        // truncation in voxels
  int halo_;                         // blocks beside a tile that are within its reach
  VoxelIndex first_block_;           // of tile (0, 0, 0)
  VoxelIndex tiles_;                 // number of tiles per axis
  VoxelIndex grid_size_;             // blocks per axis of occupied_, halo included
  std::vector<VoxelMask> occupied_;  // dense copy of the map's masks
  std::vector<Tile> distance2_;      // squared, in voxels
  std::vector<float> root_m_;        // squared distance in voxels → metres
};

}  // namespace canopeer
