#pragma once

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// One observation: registered depth and colour images of the same size as `intrinsics` says, and
/// where the camera was.
struct RgbdFrame {
  double time_s = 0.0;
  CameraIntrinsics intrinsics;
  Pose T_world_camera = Pose::Identity();
  DepthImage depth;
  ColorImage color;
};

}  // namespace canopeer
