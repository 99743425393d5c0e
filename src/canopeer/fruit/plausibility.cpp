#include "canopeer/fruit/plausibility.h"

namespace canopeer {
namespace {

/// How points and normals vary together.
struct Curvature {
  double spread = 0.0;    ///< variance of the normals: 0 for a plane, 0.25 for a cap of ± 41°
  double radius_m = 0.0;  ///< ρ of the best p ≈ c + ρ n, free of any prior
};

Curvature curvature_of(std::span<const SurfacePoint> surface, const std::vector<int>& points) {
  Vec3 mean_point = Vec3::Zero();
  Vec3 mean_normal = Vec3::Zero();
  for (const int i : points) {
    mean_point += surface[i].point;
    mean_normal += surface[i].normal;
  }
  const double count = static_cast<double>(points.size());
  mean_point /= count;
  mean_normal /= count;
  double covariance = 0.0;
  Curvature curvature;
  for (const int i : points) {
    const Vec3 dn = surface[i].normal - mean_normal;
    covariance += (surface[i].point - mean_point).dot(dn) / count;
    curvature.spread += dn.squaredNorm() / count;
  }
  if (curvature.spread > 0.0) curvature.radius_m = covariance / curvature.spread;
  return curvature;
}

bool has_fruit_size(const ShapeEstimate& shape, const FruitMapOptions& options) {
  const double longest = 1.3 * options.max_radius_m;
  return shape.radius_m >= options.min_radius_m && shape.radius_m <= options.max_radius_m &&
         shape.half_length_m >= options.min_radius_m && shape.half_length_m <= longest;
}

}  // namespace

bool is_fruit(std::span<const SurfacePoint> surface, const std::vector<int>& points,
              const ShapeEstimate& shape, const FruitMapOptions& options) {
  if (static_cast<int>(points.size()) < options.min_points) return false;
  if (!has_fruit_size(shape, options) || shape.rms_m > options.max_rms_m) return false;
  if (shape.centre.z() < options.min_height_m) return false;
  const Curvature curvature = curvature_of(surface, points);
  return curvature.spread >= options.min_normal_spread &&
         curvature.radius_m >= options.min_curvature_radius_m;
}

}  // namespace canopeer
