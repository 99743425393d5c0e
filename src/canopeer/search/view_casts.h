#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/viewgraph/view_graph.h"

namespace canopeer {

/// What a camera (optical frame) is expected to show that the map does not have: in place of
/// cast_view(). Thread-safe; depends on the map's blocks in `touched` and on the pose only.
using CastFunction = std::function<ViewCast(const VoxelMap& map, const Pose& T_world_camera)>;

/// Computes the visible sets of those of `nodes` that have none (or an outdated one), in parallel:
/// by `cast`, or by cast_view() with `fan` where there is none.
void ensure_casts(ViewGraph& graph, const std::vector<NodeId>& nodes, const VoxelMap& map,
                  const ViewFan& fan, WorkMeter& work, const CastFunction& cast = {});

}  // namespace canopeer
