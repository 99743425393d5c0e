#pragma once

#include "canopeer/base/rng.h"
#include "canopeer/search/view_path.h"

namespace canopeer {

/// A walk of `views` steps over the graph, each to an unvisited neighbour chosen uniformly: what a
/// search has to beat. Shorter when the walk runs into a dead end; empty when there is no way at
/// all. Utility 0.
[[nodiscard]] ViewPath random_walk(const ViewGraph& graph, NodeId start, int views, Rng& rng);

}  // namespace canopeer
