#pragma once

#include <optional>
#include <span>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// Two surface points this close are one.
inline constexpr double kSurfaceMatchDistanceM = 0.015;

/// How well a reconstructed surface covers the true one. All in [0, 1].
struct SurfaceScore {
  double precision = 0.0;  ///< share of the reconstructed points within the distance of a true one
  double recall = 0.0;     ///< share of the true points within the distance of a reconstructed one
  double f1 = 0.0;         ///< harmonic mean of the two; 0 when both are 0
};

/// Points on the bodies of all fruits of `scene` (or of the counted ones only), world. Each
/// triangle gets a grid of at most `spacing_m`, so the points are about as dense everywhere as the
/// mesh allows. Deterministic.
[[nodiscard]] std::vector<Eigen::Vector3f> fruit_surface_points(const Scene& scene,
                                                                bool counted_only,
                                                                double spacing_m = 0.004);

/// Share of `points` that lie within `distance_m` of one of `others`; nothing without points.
[[nodiscard]] std::optional<double> share_near(std::span<const Eigen::Vector3f> points,
                                               std::span<const Eigen::Vector3f> others,
                                               double distance_m);

/// Scores a reconstruction: precision against the surface of all fruits, recall of the counted
/// ones. Nothing when the scene counts no fruit; precision 0 when nothing was reconstructed.
[[nodiscard]] std::optional<SurfaceScore> surface_score(
    const Scene& scene, std::span<const Eigen::Vector3f> reconstructed,
    double distance_m = kSurfaceMatchDistanceM);

}  // namespace canopeer
