#pragma once

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What the exact fusion of a frame need not walk. Take a voxel that is no smaller than a pixel's
/// footprint, and the pixel its centre falls on. That pixel's ray passes the centre by at most √½
/// pixels, inside the ball of the voxel's half side, so it crosses the voxel. When the ray is free
/// well beyond the voxel, the voxel is free, and no other ray need say so.
struct SureSpace {
  /// Voxels whose centres are seen nearer than this (as find_free_space() has it) are free.
  DepthImage depth;
  /// Voxels that a pixel's ray crosses between these two depths along the axis are all of that
  /// kind. Their centres may fall on the pixels around it, so those count too. Equal: none are.
  DepthImage from;
  DepthImage to;
};

/// `free_depth`: per pixel the depth up to which its ray is free, 0: nowhere.
SureSpace find_sure_space(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
                          double resolution_m);

}  // namespace canopeer
