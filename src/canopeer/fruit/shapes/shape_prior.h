#pragma once

#include "canopeer/base/expected.h"

namespace canopeer {

/// What is known of a fruit before it is seen, and how well a smooth body describes one. By default
/// sweet peppers: length 74 ± 11 mm, mean of the two diameters 64 ± 10 mm, tilted by 8° ± 5°. All
/// positive.
struct ShapePrior {
  double radius_m = 0.032;  ///< across the axis
  double radius_sd_m = 0.005;
  double half_length_m = 0.037;  ///< along the axis
  double half_length_sd_m = 0.0055;
  double out_of_round_sd_m = 0.004;  ///< of a − b
  double e1 = 0.8;                   ///< exponents: 1 is an ellipsoid, less is blockier
  double e2 = 0.8;
  double exponent_sd = 0.15;
  double tilt_sd_rad = 0.15;  ///< of the axis off the vertical
  /// How well the surface is described by the body, noise and blockiness together.
  double surface_sd_m = 0.0025;
  /// Points of one surface are not independent evidence: a fruit counts as at most this many.
  double effective_points = 60.0;
  /// Spread of the centre around where the normals see it.
  double normal_centre_sd_m = 0.012;

  [[nodiscard]] Expected<void> validate() const;
};

/// Bounds of every fit (Marangoz et al., CASE 2022).
inline constexpr double kMinSemiAxisM = 0.02;
inline constexpr double kMaxSemiAxisM = 0.15;
inline constexpr double kMinExponent = 0.3;
inline constexpr double kMaxExponent = 0.9;

}  // namespace canopeer
