#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/fruit/shape_estimate.h"

namespace canopeer {

/// Whether the chosen points with their fitted shape are a fruit: enough of them, of a fruit's size
/// and roundness, above the floor. Turns down clips (too strongly curved), labels and strings (flat
/// or too few points) and what is no ellipsoid at all.
[[nodiscard]] bool is_fruit(std::span<const SurfacePoint> surface, const std::vector<int>& points,
                            const ShapeEstimate& shape, const FruitMapOptions& options);

}  // namespace canopeer
