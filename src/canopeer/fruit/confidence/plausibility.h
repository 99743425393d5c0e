#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/fruit/shapes/shape_estimate.h"

namespace canopeer {

/// Variance of the chosen points' normals: 0 for a plane, 0.25 for a cap of ± 41°.
[[nodiscard]] double normal_spread(std::span<const SurfacePoint> surface,
                                   const std::vector<int>& points);

/// What the surface says of a fruit beyond its shape (see FruitEvidence). By default nobody has
/// said anything against it.
struct SurfaceEvidence {
  double fruit_share = 1.0;
  double normal_spread = 0.0;
  double foreign_share = 0.0;
  double free_share = 0.0;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(fruit_share, normal_spread, foreign_share, free_share);
  }
};

/// What a fitted fruit says for being one. `cell_cm2`: area that one of its points stands for.
[[nodiscard]] FruitEvidence evidence_of(const FruitEstimate& fruit, const FruitMapOptions& options,
                                        double cell_cm2, const SurfaceEvidence& seen);

/// The shape into the estimate: pose, axes, volume, errors.
void set_shape(const SuperellipsoidFit& fit, FruitEstimate& estimate);

/// Whether the chosen points with their fitted shape are a fruit: enough of them, of a fruit's size
/// and roundness, above the floor. Turns down clips (too strongly curved), labels and strings (flat
/// or too few points) and what is no ellipsoid at all.
[[nodiscard]] bool is_fruit(std::span<const SurfacePoint> surface, const std::vector<int>& points,
                            const ShapeEstimate& shape, const FruitMapOptions& options);

}  // namespace canopeer
