#pragma once

#include <vector>

#include "canopeer/map/frontier.h"
#include "canopeer/map/frontiers/frontier_masks.h"

namespace canopeer {

/// The frontier targets inside a box, kept up to date from the blocks each frame changed: only
/// those and their neighbours are looked at again. What targets() gives is what extract_frontiers()
/// would find from scratch.
class FrontierIndex {
 public:
  /// `world` is bounded (it is kept block by block) and may be empty.
  FrontierIndex(const Box& world, double resolution_m);

  /// Takes over the blocks in `changed` (sorted); the map's resolution must be the index's. Every
  /// block whose masks changed since the last call must be among them.
  void update(const VoxelMap& map, const std::vector<BlockKey>& changed);
  void rebuild(const VoxelMap& map);

  /// Sorted as extract_frontiers() does.
  [[nodiscard]] FrontierTargets targets() const;
  [[nodiscard]] const Box& world() const { return world_; }

 private:
  /// The block's place; −1: it holds no voxel of the box.
  [[nodiscard]] std::ptrdiff_t place(const VoxelIndex& block) const;
  void compute(const VoxelMap& map, const std::vector<BlockKey>& keys);

  Box world_;
  double resolution_m_;
  VoxelIndex first_ = VoxelIndex::Zero();  // block
  VoxelIndex size_ = VoxelIndex::Zero();   // blocks
  std::vector<BlockKey> keys_;             // of all blocks of the box, sorted
  std::vector<FrontierMasks> masks_;       // parallel to keys_
};

}  // namespace canopeer
