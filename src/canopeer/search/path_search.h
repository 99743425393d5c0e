#pragma once

#include "canopeer/base/compute_cost.h"
#include "canopeer/search/view_casts.h"
#include "canopeer/search/view_path.h"

namespace canopeer {

/// How far a view sees, and how much of the graph a search looks at.
struct PathSearchOptions {
  /// Rays of one view's visible set. They end after 0.3 m of unknown space: farther behind leaves
  /// not mapped yet, a ray counts what it will hardly see.
  ViewFan fan = {.max_unknown_m = 0.3};
  /// Stands for cast_view() with that fan, to see what a better gain would be worth; empty: none.
  CastFunction cast{};
  double observe_s = 0.2;   ///< standing still at each view, part of the path's execution time L
  int max_expansions = 60;  ///< nodes taken from the queue; the rest stays unexplored
  int max_views = 12;       ///< longest path looked at; far beyond the look-ahead nothing is gained
  bool reparent = false;  ///< let a reached node take a better predecessor (the paper's text); off:
                          ///< Algorithm 1 as printed
};

/// Algorithm 1 of [Zaenker23]: best-first search from the camera's node for the view path of
/// highest utility U, eq. (1). Visible sets are computed when first needed and kept in the graph.
/// Visited nodes are passed over. The path is empty when no unvisited view can be reached. The same
/// answer with any number of threads.
[[nodiscard]] ViewPath search_path(ViewGraph& graph, NodeId start, const VoxelMap& map,
                                   const PathSearchOptions& options, WorkMeter& work);

}  // namespace canopeer
