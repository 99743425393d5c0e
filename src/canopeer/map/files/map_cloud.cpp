#include "canopeer/map/files/map_cloud.h"

namespace canopeer {

PointCloud occupied_cloud(const VoxelMap& map, const MapCloudOptions& options) {
  PointCloud cloud;
  cloud.points.reserve(static_cast<std::size_t>(map.occupied_voxels()));
  for (const BlockKey key : map.block_keys()) {
    const BlockMasks& block = *map.block(key);
    for_each_voxel(key, block.occupied, [&](const VoxelIndex& voxel) {
      cloud.points.push_back(voxel_centre(voxel, map.resolution_m()).cast<float>());
      if (options.colors) {
        cloud.colors.push_back(block.roi.test(voxel) ? options.roi : options.other);
      }
    });
  }
  return cloud;
}

PointCloud roi_cloud(const VoxelMap& map, const MapCloudOptions& options) {
  PointCloud cloud;
  cloud.points.reserve(static_cast<std::size_t>(map.roi_voxels()));
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, map.block(key)->roi, [&](const VoxelIndex& voxel) {
      cloud.points.push_back(voxel_centre(voxel, map.resolution_m()).cast<float>());
      if (options.colors) cloud.colors.push_back(options.roi);
    });
  }
  return cloud;
}

}  // namespace canopeer
