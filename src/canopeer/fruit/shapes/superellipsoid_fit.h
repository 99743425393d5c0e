#pragma once

#include <optional>
#include <span>

#include "canopeer/fruit/shapes/superellipsoid_cost.h"

namespace canopeer {

/// How much work a fruit's fit may be, and what is known of fruits beforehand.
struct FitOptions {
  ShapePrior prior;
  /// Starts are tried on so many of the points; the best goes on with all that `max_points` allows.
  int coarse_points = 64;
  int coarse_iterations = 6;  ///< each start gets so many to show what it is worth
  int max_points = 1000;      ///< more are thinned evenly
  int max_iterations = 30;
  double function_tolerance = 1e-4;  ///< relative decrease of the cost at which a fit has arrived
  double one_sided = 0.35;  ///< |mean normal| above which only one side was seen: more starts
};

/// A fitted body and how sure it is.
struct SuperellipsoidFit {
  Superellipsoid body;
  double rms_m = 0.0;               ///< of the radial distances, each clipped at 1 cm
  double cost = 0.0;                ///< minus the log posterior, up to a constant
  Vec3 centre_sd_m = Vec3::Zero();  ///< standard errors along x, y, z of the world
  double volume_sd_cm3 = 0.0;       ///< standard error of the volume
  Eigen::Matrix<double, kFitParameters, kFitParameters> covariance;
  int starts = 0;
  bool converged = false;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(body, rms_m, cost, centre_sd_m, volume_sd_cm3, covariance, starts, converged);
  }
};

/// Where the normals say the centre is: the mean of p − D n / √(nᵀ D n). Each is the centre of an
/// upright ellipsoid of the prior's size with that normal at that point.
[[nodiscard]] Vec3 centre_by_normals(std::span<const SurfacePoint> surface,
                                     const ShapePrior& prior);

/// The point nearest to all normals' lines in the least-squares sense. It is drawn towards the
/// points' mean by `weight` per 100 points (Marangoz et al., CASE 2022).
[[nodiscard]] Vec3 normals_intersection(std::span<const SurfacePoint> surface, double weight);

/// Maximum a posteriori superellipsoid of one fruit's surface points: radial Euclidean distance
/// with a Cauchy loss, the prior, bounds on axes and exponents; Ceres with analytic derivatives.
/// Standard errors come from the inverse of JᵀJ there. Tries several starts, most when only one
/// side was seen; with `before`, a fit of the same fruit, that one only. Needs at least one point,
/// all finite. Deterministic; thread-safe.
[[nodiscard]] SuperellipsoidFit fit_superellipsoid(
    std::span<const SurfacePoint> surface, const FitOptions& options = {},
    const std::optional<Superellipsoid>& before = std::nullopt);

/// The starts it tries without `before`.
[[nodiscard]] std::vector<Superellipsoid> fit_starts(std::span<const SurfacePoint> surface,
                                                     const FitOptions& options);

}  // namespace canopeer
