#include "canopeer/sensing/lens_distortion.h"

#include <Eigen/LU>
#include <cmath>

namespace canopeer {
namespace {

/// Derivative of distort() by the ideal point.
Eigen::Matrix2d jacobian(const LensDistortion& lens, const Eigen::Vector2d& p) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  const double slope = 2.0 * (lens.k1 + r2 * (2.0 * lens.k2 + r2 * 3.0 * lens.k3));
  const double across = x * y * slope + 2.0 * lens.p1 * x + 2.0 * lens.p2 * y;
  Eigen::Matrix2d j;
  j << radial + x * x * slope + 2.0 * lens.p1 * y + 6.0 * lens.p2 * x, across,  //
      across, radial + y * y * slope + 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
  return j;
}

}  // namespace

Eigen::Vector2d LensDistortion::distort(const Eigen::Vector2d& ideal) const {
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Eigen::Vector2d LensDistortion::undistort(const Eigen::Vector2d& seen) const {
  constexpr int kSteps = 20;
  constexpr double kDone = 1e-12;
  Eigen::Vector2d p = seen;
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector2d miss = distort(p) - seen;
    if (miss.squaredNorm() < kDone * kDone) break;
    const Eigen::Matrix2d j = jacobian(*this, p);
    if (std::abs(j.determinant()) < 1e-9) break;
    p -= j.inverse() * miss;
  }
  return p;
}

}  // namespace canopeer
