#include "canopeer/fruit/missing_surface.h"

#include <algorithm>

namespace canopeer {

double MissingSurface::seen_share() const {
  return samples == 0 ? 0.0 : 1.0 - static_cast<double>(points.size()) / samples;
}

MissingSurface missing_surface(const Superellipsoid& body, std::span<const SurfacePoint> seen,
                               int samples, double reach_m) {
  MissingSurface missing;
  missing.samples = samples;
  const double reach2 = reach_m * reach_m;
  for (const SurfacePoint& sample : body.surface_samples(samples)) {
    const bool is_near = std::any_of(seen.begin(), seen.end(), [&](const SurfacePoint& s) {
      return (s.point - sample.point).squaredNorm() <= reach2;
    });
    if (!is_near) missing.points.push_back(sample);
  }
  return missing;
}

}  // namespace canopeer
