#include <fmt/format.h>

#include <algorithm>

#include "canopeer/record/fruit_course.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"
#include "canopeer/report/view_intervals.h"

namespace canopeer {
namespace {

/// Value of `count` after the last view before `until_s`; 0 when there is none.
template <typename Events, typename Count>
long long at_time(const Events& events, double until_s, Count count) {
  long long value = 0;
  for (const auto& event : events) {
    if (event.t_s <= until_s) value = count(event);
  }
  return value;
}

std::string gain(long long before, long long after) {
  const long long change = after - before;
  return fmt::format("{}{}", change > 0 ? "+" : "", count_text(change));
}

struct Motions {
  double moving_s = 0.0;
  int collisions = 0;
  int contacts = 0;
};

Motions motions_of(const RunRecord& record, int segment) {
  Motions sum;
  for (const MotionEvent& motion : record.motions) {
    if (motion.segment != segment) continue;
    sum.moving_s += motion.duration_s;
    sum.collisions += motion.collision ? 1 : 0;
    sum.contacts += motion.plant_contact ? 1 : 0;
  }
  return sum;
}

double planning_of(const RunRecord& record, int segment) {
  double sum = 0.0;
  for (const ViewEvent& view : record.views) {
    if (view.segment == segment) sum += view.planning_s;
  }
  return sum;
}

template <typename Events>
long long count_in(const Events& events, int segment) {
  return std::count_if(events.begin(), events.end(),
                       [&](const auto& event) { return event.segment == segment; });
}

std::string segment_cell(const SegmentEvent& segment, bool replay) {
  const std::string text = fmt::format("{}: {}", segment.segment + 1, escape_html(segment.name));
  return replay ? html_moment(segment.start_s, text) : text;
}

std::string fruits_gained(const ReportData& data, double from_s, double to_s) {
  if (!data.found.empty()) {
    const auto count = [](const FoundAtTime& f) { return f.detected; };
    return gain(at_time(data.found, from_s, count), at_time(data.found, to_s, count));
  }
  const std::vector<FruitsAtTime> course = fruit_course(data.files.record);
  const auto count = [](const FruitsAtTime& f) { return static_cast<long long>(f.fruits->size()); };
  return gain(at_time(course, from_s, count), at_time(course, to_s, count));
}

}  // namespace

std::string segment_section(const ReportData& data) {
  const RunRecord& record = data.files.record;
  const std::vector<std::vector<double>> intervals = view_intervals(record);
  const bool on_the_way = !record.frames.empty();
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < record.segments.size(); ++i) {
    const SegmentEvent& segment = record.segments[i];
    const auto views = count_in(record.views, segment.segment);
    // Up to where the next one begins: frames of the transition between them belong to this one.
    const double from_s = i == 0 ? -1.0 : segment.start_s;
    const double to_s =
        i + 1 < record.segments.size() ? record.segments[i + 1].start_s : record.end_s;
    const auto roi = [](const ViewEvent& view) { return view.roi_voxels; };
    const Motions motions = motions_of(record, segment.segment);
    rows.push_back(
        {segment_cell(segment, data.files.replay), fmt::format("{:.0f}", segment.start_s),
         fmt::format("{:.1f}", segment.end_s - segment.start_s), std::to_string(views),
         fruits_gained(data, from_s, to_s),
         gain(at_time(record.views, from_s, roi), at_time(record.views, to_s, roi)),
         intervals[i].empty() ? "–" : fmt::format("{:.2f}", sample_spread(intervals[i]).median),
         fmt::format("{:.1f}", motions.moving_s),
         fmt::format("{:.1f}", planning_of(record, segment.segment)),
         std::to_string(motions.collisions), std::to_string(motions.contacts)});
    if (on_the_way) {
      rows.back().insert(rows.back().begin() + 4,
                         std::to_string(count_in(record.frames, segment.segment)));
    }
  }
  if (rows.empty()) return {};
  std::vector<std::string> head = {
      "Segment",
      "begin<br>s",
      "length<br>s",
      "views",
      data.found.empty() ? "fruits<br>reported" : "fruits found<br>(5 cm)",
      "ROI<br>voxels",
      "between views,<br>median s",
      "moving<br>s",
      "planning<br>s",
      "colli-<br>sions",
      "plant<br>contacts"};
  if (on_the_way) head.insert(head.begin() + 4, "frames on<br>the way");
  return html_section("Segments",
                      html_table(head, rows) +
                          (data.files.replay ? "<p class=\"note\">Names of segments and numbers of "
                                               "fruits lead to the moment in the replay, while "
                                               "<code>canopeer view</code> shows this run.</p>\n"
                                             : ""));
}

}  // namespace canopeer
