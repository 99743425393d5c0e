#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// How near a place is to a region of interest, on a coarse grid: 1 at a ROI voxel, falling
/// linearly to 0 at `reach_m` from it.
class RoiNearness {
 public:
  explicit RoiNearness(double reach_m = 0.3, double cell_m = 0.05);

  /// Takes over the ROI voxels inside `world`.
  void rebuild(const VoxelMap& map, const Box& world);
  /// 0 outside the box and before the first rebuild.
  [[nodiscard]] double at(const Vec3& p_world) const;

 private:
  [[nodiscard]] std::size_t cell_number(const VoxelIndex& cell) const;
  void raise_around(const VoxelIndex& cell);

  double reach_m_;
  double cell_m_;
  VoxelIndex first_ = VoxelIndex::Zero();
  VoxelIndex size_ = VoxelIndex::Zero();
  std::vector<float> value_;
};

}  // namespace canopeer
