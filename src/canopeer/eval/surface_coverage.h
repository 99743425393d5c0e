#pragma once

#include <vector>

#include "canopeer/scene/scene.h"
#include "canopeer/sensing/point_cloud.h"

namespace canopeer {

/// Of each true fruit (by id) the share of its surface that has a seen point within `reach_m`,
/// 0 … 1; 0 for a fruit without a body. The body's triangles are weighed by their area, large ones
/// in parts.
[[nodiscard]] std::vector<double> fruit_coverage(const Scene& scene, const PointCloud& seen,
                                                 double reach_m = 0.005);

}  // namespace canopeer
