#pragma once

#include <utility>
#include <vector>

#include "canopeer/bounds/limits/motion_bound.h"
#include "canopeer/bounds/limits/pool_fruits.h"

namespace canopeer {

/// A way to come to a view: what it costs at least, and what can be new there at most.
struct VisitColumn {
  double cost_s = 0.0;                        ///< the look before, and the motion
  double copies = 1.0;                        ///< that a plan can take of it
  std::vector<std::pair<int, float>> shares;  ///< by fruit, as in ViewFruits
};

/// What a segment offers to a plan. A plan is a sequence of views from home on; who comes from u to
/// v at cost t(u, v) finds nothing there that u alone has found. So for each v the views it is
/// reached from are taken by cost, in steps of 0.05 s, and each step is one column: cheap ways lead
/// from views that show much the same, and bring little. In any plan, of a fruit found, the shares
/// of the columns used sum to 1 at least (decision 114).
struct SegmentColumns {
  ViewFruits home;
  std::vector<VisitColumn> columns;
  double dearest_s = 0.0;  ///< largest cost
};

/// `most`: columns. One that is worth no more than another and costs no less is left out; where
/// there are still too many, those alike are merged: the greater shares, the smaller cost.
[[nodiscard]] SegmentColumns segment_columns(const FruitPatches& patches, const PoolFruits& fruits,
                                             const std::vector<PoolView>& views, double look_s,
                                             const MotionBound& motion, int most);

}  // namespace canopeer
