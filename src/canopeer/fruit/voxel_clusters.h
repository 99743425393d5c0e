#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

/// A voxel index within ± 2²⁰ as one number.
inline std::uint64_t voxel_key(const VoxelIndex& index) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
  return part(index.x()) << 42U | part(index.y()) << 21U | part(index.z());
}

/// Euclidean clusters of voxels that only ever grow: each new voxel joins every cluster with a
/// voxel in reach (union–find). Which voxels are together does not depend on their order.
class VoxelClusters {
 public:
  /// Voxels whose centres are at most `reach_voxels` apart are together.
  explicit VoxelClusters(double reach_voxels);

  /// Number of the voxel: 0, 1, 2, … in the order of first insertion.
  int insert(const VoxelIndex& index);
  /// The cluster's representative: its lowest voxel number.
  [[nodiscard]] int root(int voxel) const;
  [[nodiscard]] int size() const { return static_cast<int>(parent_.size()); }

 private:
  void unite(int a, int b);

  std::vector<VoxelIndex> reach_;
  mutable std::vector<int> parent_;                   // paths are shortened when read
  std::unordered_map<std::uint64_t, int> number_of_;  // never iterated
};

}  // namespace canopeer
