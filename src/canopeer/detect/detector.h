#pragma once

#include "canopeer/sensing/image.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// Which pixels of a frame show a fruit that counts. Both images have the frame's size.
struct Detection {
  Mask fruit;               ///< 1: fruit, 0: not
  Image<float> confidence;  ///< 0 … 1; 0 where `fruit` is 0
};

/// Finds fruit pixels in a frame. Implementations see only what a camera delivers, never ground
/// truth labels. detect() is deterministic and may be called from several threads at once.
class Detector {
 public:
  virtual ~Detector() = default;
  [[nodiscard]] virtual Detection detect(const RgbdFrame& frame) const = 0;
};

}  // namespace canopeer
