#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/fruit/shapes/shape_estimate.h"

namespace canopeer {

/// 0 for the points of connected pieces that cannot be fruit as a whole; 1 for the others. Such
/// pieces are specks (fewer than min_cluster_points), and long thin things such as pipes (longer
/// than max_piece_m, thinner than a fruit). piece[i] is the number of the piece that surface[i]
/// belongs to.
[[nodiscard]] std::vector<char> ordinary_pieces(std::span<const SurfacePoint> surface,
                                                std::span<const int> piece,
                                                const FruitMapOptions& options);

}  // namespace canopeer
