#include "mission_progress.h"

#include <algorithm>
#include <cstdio>

namespace canopeer::app {

void MissionProgress::on_event(const Event& event) {
  if (const auto* begun = std::get_if<RunBegun>(&event)) {
    run_ = *begun;
    if (begun->segment) segment_ = *begun->segment;
  }
  if (const auto* segment = std::get_if<SegmentBegun>(&event)) segment_ = segment->segment;
  if (const auto* frame = std::get_if<FrameTaken>(&event)) show(frame->view);
  if (std::holds_alternative<RunEnded>(event)) bar_.finish();
}

void MissionProgress::show(const ViewEvent& view) {
  const double done = std::min(1.0, (view.t_s - segment_.start_s) / run_.segment_time_s);
  char text[160];
  std::snprintf(text, sizeof text, "segment %d/%d  mission time %6.1f s  %4d views  %3zu fruits",
                view.segment + 1, run_.segments, view.t_s, view.view + 1, view.fruits.size());
  bar_.show((view.segment + done) / std::max(1, run_.segments), text, view.segment);
}

}  // namespace canopeer::app
