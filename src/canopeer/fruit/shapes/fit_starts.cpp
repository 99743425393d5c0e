#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/base/check.h"
#include "canopeer/fruit/shapes/shape_estimate.h"
#include "canopeer/fruit/shapes/superellipsoid_fit.h"

namespace canopeer {
namespace {

constexpr double kNormalsWeight = 2.5;  // Marangoz et al.
constexpr double kUpright_rad = 0.5;    // a prior on the tilt wider than this is none

struct Spread {
  Vec3 mean = Vec3::Zero();
  Vec3 mean_normal = Vec3::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Spread spread_of(std::span<const SurfacePoint> surface) {
  Spread spread;
  const double count = static_cast<double>(surface.size());
  for (const SurfacePoint& s : surface) {
    spread.mean += s.point / count;
    spread.mean_normal += s.normal / count;
  }
  for (const SurfacePoint& s : surface) {
    const Vec3 d = s.point - spread.mean;
    spread.covariance += d * d.transpose() / count;
  }
  return spread;
}

Eigen::Matrix3d about_z(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

/// Right-handed, along the given axes, with column k of them as its z.
Eigen::Matrix3d with_axes(const Eigen::Matrix3d& axes, int k) {
  Eigen::Matrix3d rotation;
  rotation.col(2) = axes.col(k);
  rotation.col(0) = axes.col((k + 1) % 3);
  rotation.col(1) = rotation.col(2).cross(rotation.col(0));
  return rotation;
}

Superellipsoid start_at(const Vec3& centre, double scale, const Eigen::Matrix3d& rotation,
                        const ShapePrior& prior) {
  Superellipsoid body;
  const auto in_bounds = [](double axis) {
    return std::clamp(axis, 1.02 * kMinSemiAxisM, 0.98 * kMaxSemiAxisM);
  };
  body.semi_axes_m = {in_bounds(scale * prior.radius_m), in_bounds(scale * prior.radius_m),
                      in_bounds(scale * prior.half_length_m)};
  body.e1 = std::clamp(prior.e1, kMinExponent + 0.01, kMaxExponent - 0.01);
  body.e2 = std::clamp(prior.e2, kMinExponent + 0.01, kMaxExponent - 0.01);
  body.T_world_body.translation() = centre;
  body.T_world_body.linear() = rotation;
  return body;
}

}  // namespace

Vec3 centre_by_normals(std::span<const SurfacePoint> surface, const ShapePrior& prior) {
  CANOPEER_CHECK(!surface.empty(), "a centre needs points");
  Vec3 sum = Vec3::Zero();
  for (const SurfacePoint& s : surface) {
    sum += centre_vote(s, prior.radius_m, prior.half_length_m);
  }
  return sum / static_cast<double>(surface.size());
}

Vec3 normals_intersection(std::span<const SurfacePoint> surface, double weight) {
  CANOPEER_CHECK(!surface.empty(), "an intersection needs lines");
  const Vec3 mean = spread_of(surface).mean;
  const double hold = 0.01 * weight * static_cast<double>(surface.size());
  Eigen::Matrix3d a = Eigen::Matrix3d::Identity() * hold;
  Vec3 b = Vec3::Zero();  // about the mean
  for (const SurfacePoint& s : surface) {
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - s.normal * s.normal.transpose();
    a += across;
    b += across * (s.point - mean);
  }
  return mean + a.ldlt().solve(b);
}

std::vector<Superellipsoid> fit_starts(std::span<const SurfacePoint> surface,
                                       const FitOptions& options) {
  const ShapePrior& prior = options.prior;
  const Spread spread = spread_of(surface);
  const Vec3 voted = centre_by_normals(surface, prior);
  const bool one_sided = spread.mean_normal.norm() > options.one_sided;
  constexpr double kQuarter = std::numbers::pi / 4.0;
  std::vector<Superellipsoid> starts;
  if (prior.tilt_sd_rad < kUpright_rad) {
    const auto& c = spread.covariance;
    const double yaw = 0.5 * std::atan2(2.0 * c(0, 1), c(0, 0) - c(1, 1));
    starts.push_back(start_at(voted, 1.0, about_z(yaw), prior));
    starts.push_back(start_at(voted, 1.0, about_z(yaw + kQuarter), prior));
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread.covariance);
    for (int k = 2; k >= 0; --k) {
      const Eigen::Matrix3d turned = with_axes(axes.eigenvectors(), k);
      starts.push_back(start_at(voted, 1.0, turned, prior));
      starts.push_back(start_at(voted, 1.0, turned * about_z(kQuarter), prior));
    }
  }
  if (one_sided) {
    const Vec3 crossing = normals_intersection(surface, kNormalsWeight);
    const Eigen::Matrix3d rotation = starts.front().T_world_body.linear();
    double distance = 0.0;
    for (const SurfacePoint& s : surface) distance += (s.point - crossing).norm();
    distance /= static_cast<double>(surface.size());
    starts.push_back(
        start_at(crossing, std::clamp(distance / prior.radius_m, 0.7, 1.4), rotation, prior));
    const Vec3 deeper = voted - 0.25 * prior.radius_m * spread.mean_normal.normalized();
    starts.push_back(start_at(deeper, 1.25, rotation, prior));
  }
  return starts;
}

}  // namespace canopeer
