#pragma once

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer::ros {

/// The centres of the occupied voxels, sorted by block, then z, y, x: fields x, y, z (m, in
/// `header.frame_id`, which is the world) and `intensity`, the probability that it is occupied.
[[nodiscard]] sensor_msgs::PointCloud2 occupied_cloud(const VoxelMap& map,
                                                      const std_msgs::Header& header);

/// The same of the region of interest; `intensity`: the probability that it is fruit.
[[nodiscard]] sensor_msgs::PointCloud2 roi_cloud(const VoxelMap& map,
                                                 const std_msgs::Header& header);

}  // namespace canopeer::ros
