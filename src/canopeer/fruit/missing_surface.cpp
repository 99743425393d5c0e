#include "canopeer/fruit/missing_surface.h"

#include <algorithm>
#include <vector>

namespace canopeer {

double MissingSurface::seen_share() const {
  return samples == 0 ? 0.0 : 1.0 - static_cast<double>(points.size()) / samples;
}

MissingSurface missing_surface(const Superellipsoid& body, std::span<const SurfacePoint> seen,
                               int samples, double reach_m) {
  return missing_surface(body.surface_samples(samples), seen, reach_m);
}

MissingSurface missing_surface(std::span<const SurfacePoint> samples,
                               std::span<const SurfacePoint> seen, double reach_m) {
  MissingSurface missing;
  missing.samples = static_cast<int>(samples.size());
  const double reach2 = reach_m * reach_m;
  // Sorted by height, so that only a slice of the points is looked at for each sample.
  std::vector<Vec3> by_height;
  by_height.reserve(seen.size());
  for (const SurfacePoint& s : seen) by_height.push_back(s.point);
  const auto lower = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  std::sort(by_height.begin(), by_height.end(), lower);
  for (const SurfacePoint& sample : samples) {
    const Vec3 reach(0.0, 0.0, reach_m);
    const auto from =
        std::lower_bound(by_height.begin(), by_height.end(), Vec3(sample.point - reach), lower);
    const auto to = std::upper_bound(from, by_height.end(), Vec3(sample.point + reach), lower);
    const bool is_near = std::any_of(
        from, to, [&](const Vec3& p) { return (p - sample.point).squaredNorm() <= reach2; });
    if (!is_near) missing.points.push_back(sample);
  }
  return missing;
}

}  // namespace canopeer
