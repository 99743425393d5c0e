#pragma once

#include <cstdint>

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What a labelling camera says of a pixel.
enum class PixelLabel : std::uint8_t { background, green_fruit, turning_fruit, ripe_fruit };

/// Whether the label is one of a fruit that counts.
inline bool counted_fruit(PixelLabel label) {
  return label == PixelLabel::turning_fruit || label == PixelLabel::ripe_fruit;
}

/// One observation: registered depth and colour images of the same size as `intrinsics` says, and
/// where the camera was.
struct RgbdFrame {
  double time_s = 0.0;
  CameraIntrinsics intrinsics;
  Pose T_world_camera = Pose::Identity();
  DepthImage depth;
  ColorImage color;
  /// From a camera that labels pixels, or from the simulator (with its label noise); empty: none.
  Image<PixelLabel> labels;
  /// From the simulator, where its label noise makes `labels` wrong: what detectors are scored
  /// against, and never see. Empty: the labels are right, or there are none.
  Image<PixelLabel> true_labels;
};

}  // namespace canopeer
