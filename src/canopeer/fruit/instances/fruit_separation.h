#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/fruit/shapes/shape_estimate.h"

namespace canopeer {

/// One fruit: its shape and which of the given points are its own (ascending).
struct SeparatedFruit {
  ShapeEstimate shape;
  std::vector<int> points;
};

/// Groups surface points into single fruits. Fragments of one fruit are put together, touching
/// fruits are told apart, and what is no fruit by size or shape is left out. Every point votes for
/// the centre behind it. Each peak of the votes starts a fruit, points go to the fruit they fit
/// best, and shapes are fitted again. Deterministic for the same points in the same order.
[[nodiscard]] std::vector<SeparatedFruit> separate_fruits(std::span<const SurfacePoint> surface,
                                                          const FruitMapOptions& options);

}  // namespace canopeer
