#pragma once

#include <memory>

#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// `options` with the published code's behaviour wherever it departs from the paper: nodes are
/// searched in the order of accumulated joint distance and the goal is the highest weighted gain
/// (released_search.h), 63 rays a view cast anew each time; the arm stands still for 5 s of graph
/// building before every search and the builder pauses during it (up to 2 s); one candidate is one
/// target and one camera position, with fixed roll and one IK solution; an edge to itself is one of
/// a node's five, so four are left and nodes without any stay; similarity by the published product;
/// "occupied" frontiers are those of occupied ROI voxels.
[[nodiscard]] VmpOptions released_options(VmpOptions options);

/// The published system of [Zaenker23] as its code behaves. How fast it computes is the compute
/// table's matter: `reference` holds its measured speeds.
[[nodiscard]] std::unique_ptr<Planner> make_vmp_released(const VmpOptions& options);

}  // namespace canopeer
