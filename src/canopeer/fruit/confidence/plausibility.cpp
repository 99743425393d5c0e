#include "canopeer/fruit/confidence/plausibility.h"

#include <cmath>

#include "canopeer/base/hypotenuse.h"

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

double normal_spread(std::span<const SurfacePoint> surface, const std::vector<int>& points) {
  return curvature_of(surface, points).spread;
}

FruitEvidence evidence_of(const FruitEstimate& fruit, const FruitMapOptions& options,
                          double cell_cm2, const SurfaceEvidence& seen) {
  const ShapePrior& prior = options.prior;
  const double across = 0.5 * (fruit.semi_axes_m.x() + fruit.semi_axes_m.y());
  FruitEvidence e;
  e.area_cm2 = cell_cm2 * fruit.points;
  e.seen_share = fruit.seen_share;
  e.rms_m = fruit.rms_m;
  e.fruit_share = seen.fruit_share;
  e.views = fruit.views;
  e.size_sds = hypotenuse((across - prior.radius_m) / prior.radius_sd_m,
                          (fruit.semi_axes_m.z() - prior.half_length_m) / prior.half_length_sd_m);
  e.normal_spread = seen.normal_spread;
  e.foreign_share = seen.foreign_share;
  e.free_share = seen.free_share;
  return e;
}

void set_shape(const SuperellipsoidFit& fit, FruitEstimate& e) {
  e.centre = fit.body.centre();
  e.semi_axes_m = fit.body.semi_axes_m;
  e.e1 = fit.body.e1;
  e.e2 = fit.body.e2;
  e.roll_pitch_yaw_rad = roll_pitch_yaw_of(fit.body.T_world_body.linear());
  e.volume_cm3 = 1e6 * fit.body.volume_m3();
  e.centre_sd_m = fit.centre_sd_m;
  e.volume_sd_cm3 = fit.volume_sd_cm3;
  e.rms_m = fit.rms_m;
}

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
