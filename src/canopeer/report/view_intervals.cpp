#include "canopeer/report/view_intervals.h"

namespace canopeer {

std::vector<std::vector<double>> view_intervals(const RunRecord& record) {
  std::vector<std::vector<double>> intervals(record.segments.size());
  for (std::size_t s = 0; s < record.segments.size(); ++s) {
    const ViewEvent* last = nullptr;
    for (const ViewEvent& view : record.views) {
      if (view.segment != record.segments[s].segment) continue;
      if (last) intervals[s].push_back(view.t_s - last->t_s);
      last = &view;
    }
  }
  return intervals;
}

}  // namespace canopeer
