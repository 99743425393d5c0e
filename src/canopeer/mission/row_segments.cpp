#include "canopeer/mission/row_segments.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace canopeer {
namespace {

std::tuple<double, double> place(const TrolleyState& state) {
  return {state.lift_m, state.travel_m};
}

}  // namespace

std::vector<SegmentPlan> segments_along_row(const std::vector<SegmentPlan>& segments,
                                            double segment_time_s, int max_views) {
  std::vector<SegmentPlan> sides;
  for (const SegmentPlan& segment : segments) {
    auto side = std::find_if(sides.begin(), sides.end(),
                             [&](const SegmentPlan& s) { return s.side == segment.side; });
    if (side == sides.end()) {
      side = sides.insert(sides.end(), SegmentPlan{});
      side->side = segment.side;
      side->name = "row, side " + std::to_string(segment.side);
    }
    side->time_s += segment.time_s > 0.0 ? segment.time_s : segment_time_s;
    side->max_views += max_views;
    side->row.push_back(segment.trolley);
  }
  for (SegmentPlan& side : sides) {
    std::sort(side.row.begin(), side.row.end(),
              [](const auto& a, const auto& b) { return place(a) < place(b); });
    const auto repeated =
        std::unique(side.row.begin(), side.row.end(),
                    [](const auto& a, const auto& b) { return place(a) == place(b); });
    side.row.erase(repeated, side.row.end());
    side.trolley = side.row.front();
  }
  return sides;
}

}  // namespace canopeer
