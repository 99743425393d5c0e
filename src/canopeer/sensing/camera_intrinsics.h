#pragma once

#include <cmath>
#include <numbers>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// Pinhole camera without distortion; optical frame x right, y down, z forward. Pixel (u, v) has
/// its centre at (u + 0.5, v + 0.5) in image coordinates.
struct CameraIntrinsics {
  int width = 640;
  int height = 480;
  double fx = 381.36;
  double fy = 381.36;
  double cx = 320.0;
  double cy = 240.0;
  double min_range_m = 0.15;  ///< nearer surfaces give no return (depth along the axis)
  double max_range_m = 3.0;   ///< farther surfaces give no return (depth along the axis)

  /// Square pixels, principal point in the middle; fov_x_rad is the full horizontal angle in (0,
  /// π).
  static CameraIntrinsics from_fov(int width, int height, double fov_x_rad) {
    CameraIntrinsics k;
    k.width = width;
    k.height = height;
    k.fx = k.fy = width / 2.0 / std::tan(fov_x_rad / 2.0);
    k.cx = width / 2.0;
    k.cy = height / 2.0;
    return k;
  }

  /// Direction of the pixel's centre with z = 1, camera frame: depth · ray(u, v) is the point.
  Vec3 ray(int u, int v) const { return {(u + 0.5 - cx) / fx, (v + 0.5 - cy) / fy, 1.0}; }
};

}  // namespace canopeer
