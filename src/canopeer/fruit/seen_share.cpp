#include "canopeer/fruit/seen_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace canopeer {
namespace {

constexpr int kDirections = 64;

/// Fibonacci lattice on the unit sphere.
std::array<Vec3, kDirections> even_directions() {
  std::array<Vec3, kDirections> directions;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double r = std::sqrt(1.0 - z * z);
    directions[i] = {r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z};
  }
  return directions;
}

}  // namespace

double seen_share(const ShapeEstimate& shape, std::span<const SurfacePoint> surface,
                  const std::vector<int>& points) {
  static const std::array<Vec3, kDirections> directions = even_directions();
  // A few points a direction are plenty.
  constexpr std::size_t kMaxPoints = 256;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kMaxPoints);
  const Vec3 axes(shape.radius_m, shape.radius_m, shape.half_length_m);
  std::array<bool, kDirections> seen{};
  for (std::size_t k = 0; k < points.size(); k += stride) {
    const Vec3 on_sphere = (surface[points[k]].point - shape.centre).cwiseQuotient(axes);
    int nearest = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (int d = 0; d < kDirections; ++d) {
      const double along = on_sphere.dot(directions[d]);
      if (along <= most) continue;
      most = along;
      nearest = d;
    }
    seen[nearest] = true;
  }
  int count = 0;
  for (const bool s : seen) count += s;
  return static_cast<double>(count) / kDirections;
}

}  // namespace canopeer
