#pragma once

#include <vector>

#include "canopeer/bounds/limits/motion_bound.h"
#include "canopeer/bounds/limits/pool_fruits.h"
#include "canopeer/bounds/limits/segment_times.h"

namespace canopeer {

/// By fruit, when it can be found at the earliest, mission time: when enough of it has been in
/// reach, each view on its own, straight from home at the earliest start of its segment. Infinite:
/// never.
[[nodiscard]] std::vector<double> earliest_finds_s(const ViewPool& pool, const PoolFruits& fruits,
                                                   const SegmentTimes& times,
                                                   const MotionBound& motion);

}  // namespace canopeer
