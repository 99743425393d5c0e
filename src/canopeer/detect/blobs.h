#pragma once

#include <vector>

#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// A connected piece of a mask.
struct Blob {
  int pixels = 0;
  double area_cm2 = 0.0;  ///< Σ (depth / f)²: the piece's size seen head-on
};

/// The pieces of a mask, and which piece each pixel is of.
struct BlobLabels {
  Image<int> label;  ///< index into blobs, −1 outside the mask
  std::vector<Blob> blobs;
};

/// 8-connected pieces of `mask`, numbered in scan order. Neighbouring pixels whose depths differ by
/// more than depth_step_m belong to different surfaces and do not connect. Every mask pixel must
/// have a depth.
[[nodiscard]] BlobLabels label_blobs(const RgbdFrame& frame, const Mask& mask, double depth_step_m);

}  // namespace canopeer
