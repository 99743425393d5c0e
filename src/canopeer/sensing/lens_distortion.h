#pragma once

#include <Eigen/Core>

namespace canopeer {

/// Brown–Conrady lens: radial k1, k2, k3 and tangential p1, p2, in the order and with the signs of
/// OpenCV and ROS (D. C. Brown, "Close-range camera calibration", Photogrammetric Engineering 37,
/// 1971). Works on image coordinates at depth 1: (x/z, y/z).
struct LensDistortion {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  [[nodiscard]] bool none() const {
    return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0;
  }
  /// Where the lens puts a point that a pinhole would put at `ideal`.
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& ideal) const;
  /// The ideal point that distort() takes to `seen`, by Newton's method. Within the part of the
  /// image where the lens is invertible it is exact to 1e-10; beyond it, the last estimate.
  [[nodiscard]] Eigen::Vector2d undistort(const Eigen::Vector2d& seen) const;
};

}  // namespace canopeer
