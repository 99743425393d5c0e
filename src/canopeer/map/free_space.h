#pragma once

#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/map/block.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

struct FreeBlock {
  BlockKey key = 0;
  VoxelMask free;
};

/// The voxels whose centres are seen nearer than `free_depth` (per pixel, along the axis) at the
/// pixel they project to: at most one test a voxel, whole cubes of blocks at once where the depth
/// pyramid allows. No mask is empty, no key comes twice; the order is fixed. In parallel.
std::vector<FreeBlock> find_free_space(const DepthImage& free_depth,
                                       const CameraIntrinsics& intrinsics,
                                       const Pose& T_world_camera, double resolution_m);

}  // namespace canopeer
