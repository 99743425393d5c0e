#include "canopeer/fruit/shapes/shape_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

using Parameters = Eigen::Matrix<double, 5, 1>;  // centre, radius, half length
using Normal5 = Eigen::Matrix<double, 5, 5>;

constexpr int kMaxSteps = 15;
constexpr double kConverged_m = 1e-4;
constexpr double kMinSemiAxis_m = 0.005;
constexpr double kMaxSemiAxis_m = 0.12;
constexpr double kClippedDistance_m = 0.01;  // of the reported spread: one stray point is not all

Vec3 mean_centre_vote(std::span<const SurfacePoint> surface, double radius, double half_length) {
  Vec3 sum = Vec3::Zero();
  for (const SurfacePoint& s : surface) sum += centre_vote(s, radius, half_length);
  return sum / static_cast<double>(surface.size());
}

/// Radial distance of p and its derivative by the parameters.
double radial_residual(const ShapeEstimate& shape, const Vec3& p, Parameters& derivative) {
  const double a2 = shape.radius_m * shape.radius_m;
  const double c2 = shape.half_length_m * shape.half_length_m;
  const Vec3 q = p - shape.centre;
  const double m = std::max(q.norm(), 1e-6);
  const double xy2 = q.head<2>().squaredNorm();
  const double z2 = q.z() * q.z();
  const double f = std::max(std::sqrt(xy2 / a2 + z2 / c2), 1e-6);
  const double m_f2 = m / (f * f);
  const Vec3 df_dq = Vec3(q.x() / a2, q.y() / a2, q.z() / c2) / f;
  derivative.head<3>() = -(q * ((1.0 - 1.0 / f) / m) + m_f2 * df_dq);
  derivative[3] = -m_f2 * xy2 / (a2 * shape.radius_m * f);
  derivative[4] = -m_f2 * z2 / (c2 * shape.half_length_m * f);
  return m - m / f;
}

/// Adds one residual with its weight to the normal equations.
void add_residual(double residual, const Parameters& derivative, double weight, Normal5& h,
                  Parameters& g) {
  h.noalias() += weight * derivative * derivative.transpose();
  g.noalias() += weight * residual * derivative;
}

/// Gauss–Newton equations of the posterior at `shape`.
void posterior_equations(std::span<const SurfacePoint> surface, const ShapePrior& prior,
                         const ShapeEstimate& shape, Normal5& h, Parameters& g) {
  h.setZero();
  g.setZero();
  const double count = static_cast<double>(surface.size());
  const double scale =
      std::min(1.0, prior.effective_points / count) / (prior.surface_sd_m * prior.surface_sd_m);
  const double cut = 3.0 * prior.surface_sd_m;
  Parameters derivative;
  for (const SurfacePoint& s : surface) {
    const double residual = radial_residual(shape, s.point, derivative);
    const double x = residual / cut;
    add_residual(residual, derivative, scale / (1.0 + x * x), h, g);  // Cauchy weights
  }
  const auto prior_on = [&](int parameter, double residual, double sd) {
    h(parameter, parameter) += 1.0 / (sd * sd);
    g[parameter] += residual / (sd * sd);
  };
  prior_on(3, shape.radius_m - prior.radius_m, prior.radius_sd_m);
  prior_on(4, shape.half_length_m - prior.half_length_m, prior.half_length_sd_m);
  const Vec3 vote = mean_centre_vote(surface, shape.radius_m, shape.half_length_m);
  for (int axis = 0; axis < 3; ++axis) {
    prior_on(axis, shape.centre[axis] - vote[axis], prior.normal_centre_sd_m);
  }
}

double clipped_rms(std::span<const SurfacePoint> surface, const ShapeEstimate& shape) {
  double sum = 0.0;
  for (const SurfacePoint& s : surface) {
    const double d = std::min(std::abs(shape.radial_distance(s.point)), kClippedDistance_m);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(surface.size()));
}

}  // namespace

double ShapeEstimate::radial_distance(const Vec3& p) const {
  const Vec3 q = p - centre;
  const double f = q.cwiseQuotient(Vec3(radius_m, radius_m, half_length_m)).norm();
  return f > 1e-9 ? q.norm() * (1.0 - 1.0 / f) : -std::min(radius_m, half_length_m);
}

Vec3 ShapeEstimate::normal_at(const Vec3& p) const {
  const Vec3 q = p - centre;
  const double a2 = radius_m * radius_m;
  return Vec3(q.x() / a2, q.y() / a2, q.z() / (half_length_m * half_length_m)).normalized();
}

double ShapeEstimate::volume_cm3() const {
  return 1e6 * 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * half_length_m;
}

Vec3 centre_vote(const SurfacePoint& s, double radius_m, double half_length_m) {
  const Vec3 d(radius_m * radius_m, radius_m * radius_m, half_length_m * half_length_m);
  const Vec3 dn = d.cwiseProduct(s.normal);
  return s.point - dn / std::sqrt(s.normal.dot(dn));
}

ShapeEstimate estimate_shape(std::span<const SurfacePoint> surface, const ShapePrior& prior,
                             const std::optional<ShapeEstimate>& from) {
  CANOPEER_CHECK(!surface.empty(), "a shape needs points");
  ShapeEstimate shape;
  if (from) {
    shape = *from;
  } else {
    shape.radius_m = prior.radius_m;
    shape.half_length_m = prior.half_length_m;
    shape.centre = mean_centre_vote(surface, prior.radius_m, prior.half_length_m);
  }
  Normal5 h;
  Parameters g;
  for (int step = 0; step < kMaxSteps; ++step) {
    posterior_equations(surface, prior, shape, h, g);
    Parameters change = -h.ldlt().solve(g);
    const double largest = change.cwiseAbs().maxCoeff();
    constexpr double kTrusted_m = 0.01;
    if (largest > kTrusted_m) change *= kTrusted_m / largest;
    shape.centre += change.head<3>();
    shape.radius_m = std::clamp(shape.radius_m + change[3], kMinSemiAxis_m, kMaxSemiAxis_m);
    shape.half_length_m =
        std::clamp(shape.half_length_m + change[4], kMinSemiAxis_m, kMaxSemiAxis_m);
    if (largest < kConverged_m) break;
  }
  shape.rms_m = clipped_rms(surface, shape);
  return shape;
}

}  // namespace canopeer
