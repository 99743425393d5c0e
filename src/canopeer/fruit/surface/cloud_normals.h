#pragma once

#include <optional>
#include <span>
#include <vector>

#include "canopeer/geometry/superellipsoid.h"

namespace canopeer {

/// Unit normals of a surface given by points: of the plane through the points within `radius_m`.
/// They point at `viewpoint` when there is one; else outward, away from the neighbours' mean, which
/// on a fruit lies behind the surface. Points with fewer than five neighbours get none (NaN).
[[nodiscard]] std::vector<Vec3> estimate_normals(std::span<const Vec3> points, double radius_m,
                                                 const std::optional<Vec3>& viewpoint = {});

/// Median distance of a point to its nearest neighbour, m; 0 for fewer than two points. Of large
/// clouds a sample is asked.
[[nodiscard]] double median_spacing(std::span<const Vec3> points);

/// One point, the mean, for each cell of a grid; `place[i]` is which of them points[i] went into.
[[nodiscard]] std::vector<Vec3> thin_to_grid(std::span<const Vec3> points, double cell_m,
                                             std::vector<int>& place);

}  // namespace canopeer
