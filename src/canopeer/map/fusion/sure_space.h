#pragma once

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What the exact fusion of a frame need not walk. A voxel that is no smaller than a pixel's
/// footprint is crossed by the ray of the pixel its centre falls on: that ray passes its centre by
/// at most √½ pixels, inside the ball of the voxel's half side. So when that pixel's ray is free
/// well beyond the voxel, the voxel is free, and no other ray need say so.
struct SureSpace {
  /// Voxels whose centres are seen nearer than this (as find_free_space() has it) are free.
  DepthImage depth;
  /// Voxels that a pixel's ray crosses between these two depths along the axis are all of that
  /// kind: theirs and those of the pixels around, as far as the voxels' centres can fall. Equal:
  /// none are.
  DepthImage from;
  DepthImage to;
};

/// `free_depth`: per pixel the depth up to which its ray is free, 0: nowhere.
SureSpace find_sure_space(const DepthImage& free_depth, const CameraIntrinsics& intrinsics,
                          double resolution_m);

}  // namespace canopeer
