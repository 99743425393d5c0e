#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/shape_estimate.h"

namespace canopeer {

/// Share of the shape's directions (64, evenly spread) in which at least one of the chosen points
/// lies, 0 … 1: about the share of the fruit's surface that was seen.
[[nodiscard]] double seen_share(const ShapeEstimate& shape, std::span<const SurfacePoint> surface,
                                const std::vector<int>& points);

}  // namespace canopeer
