#pragma once

#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/map/fusion/frame_kernels.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Blocks that a frame sees free; no key comes twice, no mask is empty.
struct FreeSpace {
  std::vector<BlockKey> whole;   ///< all voxels
  std::vector<FreeBlock> parts;  ///< some
};

/// The voxels whose centres are seen nearer than `free_depth` (per pixel, along the axis) at the
/// pixel they project to. A voxel is tested at most once; whole chunks and blocks at once where the
/// depth pyramid allows. The order is fixed, chunk by chunk. In parallel. What `free` held is
/// forgotten, its memory used again.
void find_free_space(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
                     const Pose& T_world_camera, double resolution_m, const FrameKernels& kernels,
                     FreeSpace& free);

}  // namespace canopeer
