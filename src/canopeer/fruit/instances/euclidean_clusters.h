#pragma once

#include <span>
#include <vector>

#include "canopeer/geometry/superellipsoid.h"

namespace canopeer {

/// Which points hang together: two are in one cluster when a chain of points joins them whose
/// neighbours are at most `tolerance_m` apart. Returns each point's cluster, numbered 0, 1, … in
/// the order of their first points.
[[nodiscard]] std::vector<int> euclidean_clusters(std::span<const SurfacePoint> points,
                                                  double tolerance_m);

}  // namespace canopeer
