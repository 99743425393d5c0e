#include "canopeer/sensing/camera_rays.h"

namespace canopeer {

CameraRays::CameraRays(const CameraIntrinsics& intrinsics, const LensDistortion& lens)
    : intrinsics_(intrinsics), lens_(lens) {
  if (lens.none()) return;
  ideal_.reserve(static_cast<std::size_t>(intrinsics.width) *
                 static_cast<std::size_t>(intrinsics.height));
  for (int v = 0; v < intrinsics.height; ++v) {
    for (int u = 0; u < intrinsics.width; ++u) {
      ideal_.push_back(lens.undistort(intrinsics.ray(u, v).head<2>()));
    }
  }
}

}  // namespace canopeer
