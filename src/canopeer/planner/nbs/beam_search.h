#pragma once

#include "canopeer/base/compute_cost.h"
#include "canopeer/planner/nbs/nbs_options.h"
#include "canopeer/search/path_search.h"

namespace canopeer {

/// Node-wise beam search over a view graph (NBS; Qu et al., "An Efficient Beam Search Algorithm for
/// Active Perception in Mobile Robotics", IJRR 2026, arXiv 2604.23327), our reading of it.
///
/// A partial path p begins at `start` and takes unvisited views, each once, within T =
/// `horizon_s`. With m_i the distinct unknown voxels its i-th view adds and t_i when it is taken,
/// its gain is g(p) = Σ m_i (1 − t_i/T) (without `early`: Σ m_i). Its frontier are the views it
/// could take next; ρ(p) is the highest m/Δt among them, the best rate at which it can go on. The
/// expected gain q(p) = g(p) + promise · ρ(p) · (T − t) · (1 − t/T)/2 takes that rate to the end
/// (without `early`: without the last factor). A path not extended yet has the ρ its parent
/// has without it: gains are submodular, so none of those views gets better.
///
/// Paths are extended view by view, the most promising of each length first. Each node keeps the B
/// best paths that end there, of whatever length. The greedy path, by m/Δt, is always among them.
/// The answer is the path of highest q.
///
/// Empty when no view fits into T. `views`: what a view sees and how long it takes; its own limits
/// are not looked at. `utility` is g(p). The same answer with any number of threads.
[[nodiscard]] ViewPath search_beams(ViewGraph& graph, NodeId start, const VoxelMap& map,
                                    const PathSearchOptions& views, const NbsOptions& options,
                                    double horizon_s, WorkMeter& work);

}  // namespace canopeer
