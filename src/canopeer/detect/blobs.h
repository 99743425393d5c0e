#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// Calls f(u, v) for each pixel of the mask, row by row. Quick where few are in it.
template <typename F>
void for_each_pixel_in(const Mask& mask, F&& f) {
  const std::uint8_t* const in = mask.pixels().data();
  const std::size_t count = mask.pixels().size();
  const auto width = static_cast<std::size_t>(mask.width());
  for (std::size_t i = 0; i < count;) {
    std::uint64_t eight = 1;
    if (i + sizeof eight <= count) std::memcpy(&eight, in + i, sizeof eight);
    const std::size_t end = i + sizeof eight;
    for (; eight != 0 && i < end && i < count; ++i) {
      if (in[i] != 0) f(static_cast<int>(i % width), static_cast<int>(i / width));
    }
    i = end;
  }
}

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
