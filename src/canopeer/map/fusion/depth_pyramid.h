#pragma once

#include "canopeer/map/fusion/frame_kernels.h"
#include "canopeer/map/storage/huge_memory.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Range of depths in any rectangle of an image in constant time. It keeps minima and maxima of
/// square windows of 2, 4, 8 … pixels; four windows of the level below make one. (A sparse table in
/// two dimensions: Bender & Farach-Colton 2000, here at every second pixel.)
class DepthPyramid {
 public:
  /// `depth` must have the size `k` says and at least one pixel, all finite and none negative,
  /// and outlive the pyramid.
  DepthPyramid(const DepthImage& depth, const CameraIntrinsics& k, const FrameKernels& kernels);
  ~DepthPyramid();
  DepthPyramid(const DepthPyramid&) = delete;
  DepthPyramid& operator=(const DepthPyramid&) = delete;

  /// As the kernels want it; points into the pyramid and the image.
  [[nodiscard]] const FlatPyramid& flat() const { return flat_; }

 private:
  FlatPyramid flat_;
  HugeMemory memory_;  // of bounds and coarse depths
};

}  // namespace canopeer
