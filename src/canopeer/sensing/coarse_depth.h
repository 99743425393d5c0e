#pragma once

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// A depth image of fewer pixels, with the pinhole that it is of.
struct CoarseDepth {
  CameraIntrinsics intrinsics;
  DepthImage depth;
};

/// Each `step` × `step` pixels become one, step ≥ 1: the mean of their inverse depth, in which a
/// plane is linear and a stereo camera's noise even. Nothing (0) where fewer than half of them show
/// a surface, or an edge runs through. What is left over at the right and the lower rim is cut off.
[[nodiscard]] CoarseDepth coarse_depth(const CameraIntrinsics& intrinsics, const DepthImage& depth,
                                       int step);

}  // namespace canopeer
