#pragma once

#include <span>
#include <vector>

#include "canopeer/geometry/superellipsoid.h"

namespace canopeer {

/// What of a fitted body nobody has seen: those of even samples of its surface that are farther
/// than `reach_m` from every point (Marangoz et al., CASE 2022).
struct MissingSurface {
  std::vector<SurfacePoint> points;  ///< world
  int samples = 0;

  /// 0 … 1: 1 when nothing is missing.
  [[nodiscard]] double seen_share() const;
};

[[nodiscard]] MissingSurface missing_surface(std::span<const SurfacePoint> samples,
                                             std::span<const SurfacePoint> seen,
                                             double reach_m = 0.015);
[[nodiscard]] MissingSurface missing_surface(const Superellipsoid& body,
                                             std::span<const SurfacePoint> seen, int samples = 128,
                                             double reach_m = 0.015);

}  // namespace canopeer
