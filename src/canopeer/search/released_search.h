#pragma once

#include "canopeer/base/compute_cost.h"
#include "canopeer/search/view_path.h"

namespace canopeer {

/// What a view of the published search sees, and when the search stops.
struct ReleasedSearchOptions {
  ViewFan fan{.columns = 9, .rows = 7};
  double time_limit_s = 2.0;  ///< by the cost table; 0: none
};

/// The path search of the published code, where it departs from the paper. Nodes are expanded in
/// the order of accumulated cost; cost is joint distance (Σ|Δq|). The goal is the node with the
/// highest |C|_unknown · (ROI + 1)/(t + 1), not divided by cost; `utility` of the result is that
/// gain. Each node keeps its first predecessor. Every visible set is cast anew in every search.
/// Stops when the work done is worth `time_limit_s`.
[[nodiscard]] ViewPath search_released(ViewGraph& graph, NodeId start, const VoxelMap& map,
                                       const ReleasedSearchOptions& options, const CostTable& costs,
                                       WorkMeter& work);

}  // namespace canopeer
