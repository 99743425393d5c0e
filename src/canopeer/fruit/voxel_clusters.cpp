#include "canopeer/fruit/voxel_clusters.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

VoxelClusters::VoxelClusters(double reach_voxels) {
  const int reach = static_cast<int>(std::ceil(reach_voxels));
  const double reach2 = reach_voxels * reach_voxels + 1e-9;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const VoxelIndex offset(x, y, z);
        const int distance2 = offset.squaredNorm();
        if (distance2 > 0 && distance2 <= reach2) reach_.push_back(offset);
      }
    }
  }
}

int VoxelClusters::insert(const VoxelIndex& index) {
  const auto [entry, is_new] = number_of_.try_emplace(voxel_key(index), size());
  const int number = entry->second;
  if (!is_new) return number;
  parent_.push_back(number);
  for (const VoxelIndex& offset : reach_) {
    const auto neighbour = number_of_.find(voxel_key(index + offset));
    if (neighbour != number_of_.end()) unite(number, neighbour->second);
  }
  return number;
}

int VoxelClusters::root(int voxel) const {
  while (parent_[voxel] != voxel) {
    parent_[voxel] = parent_[parent_[voxel]];
    voxel = parent_[voxel];
  }
  return voxel;
}

void VoxelClusters::unite(int a, int b) {
  const int root_a = root(a);
  const int root_b = root(b);
  parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

}  // namespace canopeer
