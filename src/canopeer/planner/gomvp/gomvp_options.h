#pragma once

#include "canopeer/map/view_cast.h"
#include "canopeer/viewgraph/target_sampler.h"

namespace canopeer {

/// Targets, views and limits of gomvp_recon and gomvp_t.
struct GomvpOptions {
  TargetShares shares{};         ///< of the targets, by kind
  int max_targets = 120;         ///< frontier voxels a path is made for, ≥ 1
  double target_grid_m = 0.025;  ///< one target a cell of this edge length, > 0
  int max_candidates = 300;      ///< views that are asked what they see: the newest, ≥ 1
  int max_views = 30;            ///< of those, the ones the program chooses from, 1 … 1000
  int neighbors = 10;            ///< arcs of a view lead to so many nearest, ≥ 1
  int max_nodes = 1;             ///< of the branch and bound, ≥ 0; 0: the root alone
  int max_iterations = 300;      ///< of the simplex in all, looked at between nodes; 0: no solver
  double replan_share = 0.3;     ///< of a path's targets seen: planned anew, (0, 1]
  int give_up_after = 40;        ///< searches in a row in which no view sees a target: done, ≥ 1
  // What a target is worth to gomvp_t.
  double roi_weight = 4.0;
  double occupied_weight = 2.0;
  double border_weight = 1.0;
  double observe_s = 0.2;                ///< standing still at a view; of the search's options
  ViewFan fan = {.max_unknown_m = 0.3};  ///< what a view sees; of the search's options
};

}  // namespace canopeer
