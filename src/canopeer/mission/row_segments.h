#pragma once

#include <vector>

#include "canopeer/mission/mission_options.h"

namespace canopeer {

/// The same work for planners that drive along the row themselves (PlannerManners): all
/// segments of one side as one, in the order in which the sides come first, called "row, side 1".
/// Its `row` are their trolley states, each once, by lift height and along the row; it begins at
/// the first of them. Its budget is the sum of theirs; `segment_time_s` is that of segments
/// without one of their own, `max_views` how many views each may take (0: any number).
[[nodiscard]] std::vector<SegmentPlan> segments_along_row(const std::vector<SegmentPlan>& segments,
                                                          double segment_time_s, int max_views = 0);

}  // namespace canopeer
