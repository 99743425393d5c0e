#pragma once

#include <optional>
#include <span>

#include "canopeer/fruit/shapes/shape_prior.h"
#include "canopeer/geometry/superellipsoid.h"

namespace canopeer {

/// A spheroid that hangs upright (peppers tilt by 8° ± 5°).
struct ShapeEstimate {
  Vec3 centre = Vec3::Zero();
  double radius_m = 0.0;       ///< semi-axis across z
  double half_length_m = 0.0;  ///< semi-axis along z
  double rms_m = 0.0;          ///< robust spread of the radial distances, m

  /// Signed distance along the ray from the centre through p: negative inside.
  [[nodiscard]] double radial_distance(const Vec3& p) const;
  /// Outward unit normal of the level set through p.
  [[nodiscard]] Vec3 normal_at(const Vec3& p) const;
  [[nodiscard]] double volume_cm3() const;
};

/// Where an upright spheroid with these semi-axes and normal n at p has its centre. An ellipsoid
/// with D = diag(a², a², c²) has normal n at D n / √(nᵀ D n) from its centre.
[[nodiscard]] Vec3 centre_vote(const SurfacePoint& surface, double radius_m, double half_length_m);

/// Maximum a posteriori spheroid of one fruit's surface points: robust radial distances, the prior
/// on both semi-axes, and the normals' vote for the centre. From one side only the centre comes out
/// within about a centimetre. `from`: where to start, nearer than the prior's size. Needs at least
/// one point. Deterministic.
[[nodiscard]] ShapeEstimate estimate_shape(std::span<const SurfacePoint> surface,
                                           const ShapePrior& prior = {},
                                           const std::optional<ShapeEstimate>& from = std::nullopt);

}  // namespace canopeer
