#pragma once

#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/viewgraph/view_graph.h"

namespace canopeer {

/// Computes the visible sets of those of `nodes` that have none (or an outdated one), in parallel.
void ensure_casts(ViewGraph& graph, const std::vector<NodeId>& nodes, const VoxelMap& map,
                  const ViewFan& fan, WorkMeter& work);

}  // namespace canopeer
