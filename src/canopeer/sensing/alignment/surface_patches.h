#pragma once

#include <vector>

#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// A piece of surface that a depth image shows, camera frame.
struct SurfacePatch {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< unit, away from the camera
};

/// The flat pieces of a depth image, found again by pixel.
class SurfacePatches {
 public:
  /// Plane fits about every `step`-th pixel, step ≥ 1. In a pinhole's image a plane's inverse depth
  /// is linear in the pixel, and a stereo camera's noise even. Edges, seams and grazing surfaces
  /// are left out.
  SurfacePatches(const CameraIntrinsics& intrinsics, const DepthImage& depth, int step);

  [[nodiscard]] const std::vector<SurfacePatch>& all() const { return patches_; }
  /// The patch next to where the camera sees a point of its frame; null: none there.
  [[nodiscard]] const SurfacePatch* seen_at(const Eigen::Vector3f& point) const {
    if (!(point.z() > 0.0F)) return nullptr;
    const float u = point.x() / point.z() * fx_ + cx_, v = point.y() / point.z() * fy_ + cy_;
    if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(across_) &&
          v < static_cast<float>(down_))) {
      return nullptr;
    }
    const int index = index_[static_cast<std::size_t>(v) * static_cast<std::size_t>(across_) +
                             static_cast<std::size_t>(u)];
    return index < 0 ? nullptr : &patches_[static_cast<std::size_t>(index)];
  }

 private:
  // The pinhole of the coarse image whose pixels are the patches.
  float fx_ = 0, fy_ = 0, cx_ = 0, cy_ = 0;
  int across_ = 0, down_ = 0;
  std::vector<int> index_;  // row by row; −1: none
  std::vector<SurfacePatch> patches_;
};

}  // namespace canopeer
