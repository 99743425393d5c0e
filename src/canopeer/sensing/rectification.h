#pragma once

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/lens_distortion.h"

namespace canopeer {

/// Takes the lens out of images, as camera drivers do. Each pixel of the pinhole image gets the
/// nearest pixel of the one seen through the lens. So depth stays unmixed, and all images stay
/// registered. The intrinsics are the same before and after.
class Rectification {
 public:
  Rectification(const CameraIntrinsics& intrinsics, const LensDistortion& lens);

  /// `outside` where the lens did not look. `raw` has the size of the intrinsics.
  template <typename T>
  [[nodiscard]] Image<T> apply(const Image<T>& raw, T outside) const {
    Image<T> flat(raw.width(), raw.height(), outside);
    for (std::size_t i = 0; i < source_.size(); ++i) {
      if (source_[i] >= 0) flat.pixels()[i] = raw.pixels()[static_cast<std::size_t>(source_[i])];
    }
    return flat;
  }

 private:
  std::vector<int> source_;  // index of the raw pixel, −1: none
};

}  // namespace canopeer
