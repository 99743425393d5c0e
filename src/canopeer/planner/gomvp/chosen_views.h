#pragma once

#include <vector>

#include "canopeer/base/compute_cost.h"
#include "canopeer/planner/gomvp/cover_targets.h"
#include "canopeer/planner/gomvp/graph_ways.h"

namespace canopeer {

/// A view of the graph, and which of the targets it sees.
struct ChosenView {
  NodeId node{};
  std::vector<int> targets;  ///< ascending
};

/// The camera at T_world_camera sees p_world: it lies in the fan, and the ray there meets nothing
/// occupied and crosses no more than `fan.max_unknown_m` of unknown space before it ends.
[[nodiscard]] bool sees(const VoxelMap& map, const Pose& T_world_camera, const Vec3& p_world,
                        const ViewFan& fan);

/// Views V of the program and, by that, the sets S_j: of the newest unvisited views that `ways`
/// reach, at most `max_views` that see targets. The one whose targets are worth most is taken
/// first; a target that k of those taken see is worth 1 / (1 + k) of its weight to the next. So
/// each target keeps several views to be seen from, and views that only repeat others stay out. The
/// newest, because they were drawn for the frontier as it is now.
[[nodiscard]] std::vector<ChosenView> choose_views(const ViewGraph& graph, const GraphWays& ways,
                                                   const VoxelMap& map,
                                                   const std::vector<CoverTarget>& targets,
                                                   const std::vector<double>& weights,
                                                   const GomvpOptions& options, WorkMeter& work);

}  // namespace canopeer
