#include "canopeer/ros2/out/voxel_cloud.h"

#include <array>
#include <cmath>
#include <cstring>

namespace canopeer::ros {
namespace {

using VoxelPoint = std::array<float, 4>;  // x, y, z, probability

float probability(double log_odds) { return static_cast<float>(1.0 / (1.0 + std::exp(-log_odds))); }

sensor_msgs::PointCloud2 cloud_of(const std::vector<VoxelPoint>& points,
                                  const std_msgs::Header& header) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.fields = {{"x", 0, PointField::FLOAT32, 1},
                  {"y", 4, PointField::FLOAT32, 1},
                  {"z", 8, PointField::FLOAT32, 1},
                  {"intensity", 12, PointField::FLOAT32, 1}};
  cloud.point_step = sizeof(VoxelPoint);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.row_step);
  if (!points.empty()) std::memcpy(cloud.data.data(), points.data(), cloud.data.size());
  cloud.is_dense = true;
  return cloud;
}

VoxelPoint voxel_point(const VoxelMap& map, const VoxelIndex& voxel, double log_odds) {
  const Eigen::Vector3f centre = voxel_centre(voxel, map.resolution_m()).cast<float>();
  return {centre.x(), centre.y(), centre.z(), probability(log_odds)};
}

}  // namespace

sensor_msgs::PointCloud2 occupied_cloud(const VoxelMap& map, const std_msgs::Header& header) {
  std::vector<VoxelPoint> points;
  points.reserve(static_cast<std::size_t>(map.occupied_voxels()));
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, map.block(key)->occupied, [&](const VoxelIndex& voxel) {
      points.push_back(voxel_point(map, voxel, map.occupancy_log_odds(voxel)));
    });
  }
  return cloud_of(points, header);
}

sensor_msgs::PointCloud2 roi_cloud(const VoxelMap& map, const std_msgs::Header& header) {
  std::vector<VoxelPoint> points;
  points.reserve(static_cast<std::size_t>(map.roi_voxels()));
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, map.block(key)->roi, [&](const VoxelIndex& voxel) {
      points.push_back(voxel_point(map, voxel, map.roi_log_odds(voxel)));
    });
  }
  return cloud_of(points, header);
}

}  // namespace canopeer::ros
