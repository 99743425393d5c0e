#pragma once

#include "canopeer/robot/motion_planner.h"

namespace canopeer {

/// What a view is worth to the next-best-view planner: view_gains.h.
enum class NbvGain { uvc, uvpc, oae, osamcep };

/// Views drawn for a decision, and how they are ranked. Where views are drawn, and the rays of one,
/// is VMP's (VmpOptions::builder, path_search.fan).
struct NbvOptions {
  NbvGain gain = NbvGain::uvpc;
  int views = 60;                ///< drawn for one decision
  double distance_weight = 2.0;  ///< utility = gain / highest gain − this · camera's way (1/m)
  double visibility_cell_m = 0.05;  ///< see GainScene
  int max_plans = 20;               ///< motions planned in one decision at most
  MotionPlannerOptions motion{.max_iterations = 3000};
};

}  // namespace canopeer
