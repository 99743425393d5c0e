#pragma once

#include <vector>

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/lens_distortion.h"

namespace canopeer {

/// Where each pixel of a camera looks, lens included; reckoned once when there is a lens.
class CameraRays {
 public:
  explicit CameraRays(const CameraIntrinsics& intrinsics, const LensDistortion& lens = {});

  [[nodiscard]] const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  [[nodiscard]] const LensDistortion& lens() const { return lens_; }
  /// Direction of the pixel's centre with z = 1, camera frame.
  [[nodiscard]] Vec3 ray(int u, int v) const {
    if (ideal_.empty()) return intrinsics_.ray(u, v);
    const Eigen::Vector2d& p = ideal_[static_cast<std::size_t>(v * intrinsics_.width + u)];
    return {p.x(), p.y(), 1.0};
  }

 private:
  CameraIntrinsics intrinsics_;
  LensDistortion lens_;
  std::vector<Eigen::Vector2d> ideal_;  // row by row; empty: no lens
};

}  // namespace canopeer
