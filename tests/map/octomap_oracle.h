#pragma once

#include <octomap/octomap.h>

#include <cmath>

#include "canopeer/map/voxel_map.h"
#include "canopeer/sensing/rgbd_frame.h"

// OctoMap, the map that ours is held against.

namespace canopeer {

/// The voxel an OctoMap key stands for.
inline VoxelIndex index_of(const octomap::OcTreeKey& key) {
  return {key[0] - 32768, key[1] - 32768, key[2] - 32768};
}

/// A frame's points in the world, as OctoMap takes them.
inline octomap::Pointcloud octomap_cloud(const RgbdFrame& frame) {
  octomap::Pointcloud cloud;
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      const double depth = static_cast<double>(frame.depth.at(u, v));
      const Eigen::Vector3f p =
          (frame.T_world_camera * (depth * frame.intrinsics.ray(u, v))).cast<float>();
      if (p.allFinite()) cloud.push_back(p.x(), p.y(), p.z());
    }
  }
  return cloud;
}

inline void insert_frame(const RgbdFrame& frame, double max_range_m, octomap::OcTree& tree) {
  const Eigen::Vector3f o = frame.T_world_camera.translation().cast<float>();
  tree.insertPointCloud(octomap_cloud(frame), octomap::point3d(o.x(), o.y(), o.z()), max_range_m);
}

/// Voxels that OctoMap knows, and how many of them our map has otherwise.
struct Comparison {
  std::int64_t compared = 0;
  std::int64_t different = 0;
};

inline Comparison compare(const VoxelMap& map, octomap::OcTree& tree) {
  tree.expand();
  Comparison c;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const VoxelIndex v = index_of(leaf.getKey());
    ++c.compared;
    const bool same =
        std::abs(map.occupancy_log_odds(v) - static_cast<double>(leaf->getLogOdds())) < 1e-3 &&
        (map.occupancy(v) == Occupancy::occupied) == tree.isNodeOccupied(*leaf);
    c.different += !same;
  }
  return c;
}

}  // namespace canopeer
