#pragma once

#include <octomap/octomap.h>

#include <vector>

#include "ball_scene.h"
#include "canopeer/map/voxel_map.h"

// What the map's benchmarks look at: a 2 m row of leaves and fruit (small balls) in front of a
// wall, 1 cm voxels, 640 × 480 depth images.

namespace canopeer {

inline constexpr double kResolution = 0.01;
inline constexpr int kViews = 6;
inline const CameraIntrinsics kCamera = CameraIntrinsics::from_fov(640, 480, 1.396);
inline const Box kSamplingRegion{Vec3(0.3, -1.0, -0.6), Vec3(1.3, 1.0, 0.6)};

/// The frames that are fused, with their ROI masks.
const std::vector<BallScene::View>& views();
/// Poses for view queries: many, so that no view finds the caches as it left them.
const std::vector<Pose>& view_poses();
/// All frames but the last, fused.
const VoxelMap& fused_map();
/// The same map as an octree (values copied, so that queries see the same world).
const octomap::OcTree& fused_octree();

octomap::point3d point(const Vec3& p);

}  // namespace canopeer
