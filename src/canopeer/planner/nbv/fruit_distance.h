#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// How far voxels are from the nearest region of interest, up to a reach: between the centres of
/// voxels, exact.
class FruitDistance {
 public:
  explicit FruitDistance(double reach_m = 0.1) : reach_m_(reach_m) {}

  /// Takes over the ROI voxels inside `world`.
  void rebuild(const VoxelMap& map, const Box& world);
  /// 0 at a ROI voxel; nothing at the reach and farther, or before the first rebuild. Thread-safe.
  [[nodiscard]] std::optional<double> at(const VoxelIndex& voxel) const;

 private:
  [[nodiscard]] std::size_t cell(const VoxelIndex& local) const;
  void spread(int axis);

  double reach_m_;
  double resolution_m_ = 0.01;
  int reach_ = 0;  // in voxels, rounded up
  VoxelIndex first_ = VoxelIndex::Zero();
  VoxelIndex size_ = VoxelIndex::Zero();
  std::vector<std::int32_t> squared_;  // in voxels; x fastest
};

}  // namespace canopeer
