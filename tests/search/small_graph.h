#pragma once

#include <cstdint>
#include <set>
#include <tuple>

#include "canopeer/base/rng.h"
#include "canopeer/search/view_path.h"

namespace canopeer::test {

/// A view that sees the given voxels and faces `kind`; its visible set is in place already.
NodeId add_view(ViewGraph& graph, TargetKind kind, const std::vector<VoxelIndex>& sees);

/// A random blob of voxels, so that views overlap.
std::vector<VoxelIndex> random_voxels(Rng& rng, int count);

/// `nodes` views, node 0 the camera's; a random tree, plus `extra_edges` more.
ViewGraph random_graph(Rng& rng, int nodes, int extra_edges);

/// U of eq. (1) along start → nodes, with sets of single voxels: the specification.
double utility_by_definition(const ViewGraph& graph, NodeId start,
                             const std::vector<NodeId>& nodes);

}  // namespace canopeer::test
