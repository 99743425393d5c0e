#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// Which pixels of a frame show a fruit. All images have the frame's size.
struct Detection {
  Image<PixelLabel>
      label;   ///< what each pixel shows, green fruits too where the detector knows them
  Mask fruit;  ///< 0: no fruit that counts; else the PixelLabel (turning or ripe) as a number
  Image<float> confidence;  ///< 0 … 1 that the label is right; 0 on the background
};

/// Finds fruit pixels in a frame. Pixels without depth are never fruit. detect() is deterministic
/// and may be called from several threads at once.
class Detector {
 public:
  virtual ~Detector() = default;
  /// The error says what of the frame the detector cannot do with; it never fails on a frame it
  /// was made for.
  [[nodiscard]] virtual Expected<Detection> detect(const RgbdFrame& frame) const = 0;
};

}  // namespace canopeer
