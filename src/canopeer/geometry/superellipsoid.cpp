#include "canopeer/geometry/superellipsoid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canopeer {
namespace {

/// Keeps logarithms and quotients finite on the body's planes of symmetry.
constexpr double kTiny = 1e-9;

double beta(double x, double y) { return std::tgamma(x) * std::tgamma(y) / std::tgamma(x + y); }

struct GaugeParts {
  double gauge = 0.0;
  Vec3 gradient = Vec3::Zero();  ///< of log gauge, body frame
};

GaugeParts gauge_parts(const Superellipsoid& body, const Vec3& q) {
  const Vec3 s = q.cwiseAbs().cwiseQuotient(body.semi_axes_m).cwiseMax(kTiny);
  const double a = std::pow(s.x(), 2.0 / body.e2);
  const double b = std::pow(s.y(), 2.0 / body.e2);
  const double across = std::pow(a + b, body.e2 / body.e1);
  const double along = std::pow(s.z(), 2.0 / body.e1);
  const double f = across + along;
  const auto away_from_zero = [](double v) {
    return std::copysign(std::max(std::abs(v), kTiny * 1e-2), v);
  };
  GaugeParts parts;
  parts.gauge = std::pow(f, 0.5 * body.e1);
  parts.gradient = {across / f * a / (a + b) / away_from_zero(q.x()),
                    across / f * b / (a + b) / away_from_zero(q.y()),
                    along / f / away_from_zero(q.z())};
  return parts;
}

}  // namespace

double Superellipsoid::gauge(const Vec3& p_world) const {
  return gauge_parts(*this, T_world_body.inverse() * p_world).gauge;
}

double Superellipsoid::radial_distance(const Vec3& p_world) const {
  const Vec3 q = T_world_body.inverse() * p_world;
  const double distance = q.norm();
  if (distance < kTiny) return -semi_axes_m.minCoeff();
  return distance * (1.0 - 1.0 / gauge_parts(*this, q).gauge);
}

Vec3 Superellipsoid::normal_at(const Vec3& p_world) const {
  const Vec3 q = T_world_body.inverse() * p_world;
  if (q.norm() < kTiny) return T_world_body.linear().col(2);
  return T_world_body.linear() * gauge_parts(*this, q).gradient.normalized();
}

double Superellipsoid::volume_m3() const {
  return 2.0 * semi_axes_m.prod() * e1 * e2 * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2);
}

std::vector<SurfacePoint> Superellipsoid::surface_samples(int count) const {
  std::vector<SurfacePoint> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (const Vec3& direction : fibonacci_directions(count)) {
    const Vec3 q = direction.cwiseProduct(semi_axes_m);
    const GaugeParts parts = gauge_parts(*this, q);
    samples.push_back(
        {T_world_body * (q / parts.gauge), T_world_body.linear() * parts.gradient.normalized()});
  }
  return samples;
}

std::vector<Vec3> fibonacci_directions(int count) {
  std::vector<Vec3> directions;
  directions.reserve(static_cast<std::size_t>(count));
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
  }
  return directions;
}

Eigen::Matrix3d rotation_of(const Vec3& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

Vec3 roll_pitch_yaw_of(const Eigen::Matrix3d& r) {
  return {std::atan2(r(2, 1), r(2, 2)), std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
          std::atan2(r(1, 0), r(0, 0))};
}

}  // namespace canopeer
