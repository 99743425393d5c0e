#pragma once

#include <functional>
#include <vector>

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/lens_distortion.h"

namespace canopeer {

/// Takes the lens out of images, as camera drivers do. Each pixel of the pinhole image gets the
/// nearest pixel of the one seen through the lens. So depth stays unmixed, and all images stay
/// registered.
class Rectification {
 public:
  /// Where a lens puts a point that a pinhole would put elsewhere, both at depth 1: (x/z, y/z).
  /// NaN: the lens does not look there.
  using Lens = std::function<Eigen::Vector2d(const Eigen::Vector2d& ideal)>;

  /// The intrinsics are the same before and after.
  Rectification(const CameraIntrinsics& intrinsics, const LensDistortion& lens);
  /// From images behind a lens of intrinsics `raw` to those of a pinhole of intrinsics `flat`.
  Rectification(const CameraIntrinsics& flat, const CameraIntrinsics& raw, const Lens& lens);

  /// `outside` where the lens did not look. `raw` has the size of its intrinsics.
  template <typename T>
  [[nodiscard]] Image<T> apply(const Image<T>& raw, T outside) const {
    Image<T> flat(width_, height_, outside);
    for (std::size_t i = 0; i < source_.size(); ++i) {
      if (source_[i] >= 0) flat.pixels()[i] = raw.pixels()[static_cast<std::size_t>(source_[i])];
    }
    return flat;
  }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<int> source_;  // index of the raw pixel, −1: none
};

}  // namespace canopeer
