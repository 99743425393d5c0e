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
  if (const auto* frame = std::get_if<FrameTaken>(&event)) {
    views_ = frame->view.view + 1;
    show(frame->view.segment, frame->view.t_s, frame->view.fruits.size());
  }
  if (const auto* on_the_way = std::get_if<FrameOnTheWay>(&event)) {
    ++frames_;
    const FrameEvent& frame = on_the_way->frame;
    show(frame.segment, frame.t_s, frame.fruits.size());
  }
  if (std::holds_alternative<RunEnded>(event)) bar_.finish();
}

void MissionProgress::show(int segment, double t_s, std::size_t fruits) {
  // Without a time limit nobody knows.
  const double limit_s = run_.segment_time_s;
  const double done = limit_s > 0.0 ? std::min(1.0, (t_s - segment_.start_s) / limit_s) : 0.0;
  char frames[32] = "";
  if (frames_ > 0) std::snprintf(frames, sizeof frames, " + %d on the way", frames_);
  char text[160];
  std::snprintf(text, sizeof text, "segment %d/%d  mission time %6.1f s  %4d views%s  %3zu fruits",
                segment + 1, run_.segments, t_s, views_, frames, fruits);
  bar_.show((segment + done) / std::max(1, run_.segments), text, segment);
}

}  // namespace canopeer::app
