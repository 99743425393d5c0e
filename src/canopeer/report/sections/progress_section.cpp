#include <algorithm>
#include <optional>

#include "canopeer/record/fruit_course.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

using Points = SvgPlot::Points;

/// From nothing at time 0 to the last count at the end of the run.
template <typename Events, typename Time, typename Count>
Points course(const Events& events, double end_s, Time time, Count count) {
  Points points = {{0.0, 0.0}};
  for (const auto& event : events) points.emplace_back(time(event), count(event));
  points.emplace_back(end_s, points.back().second);
  return points;
}

/// T of a clock that never stops; nothing: each segment has its own.
std::optional<double> whole_time_s(const ReportData& data) {
  const double t_s = data.files.record.header.mission_time_s;
  return t_s > 0.0 ? std::optional(t_s) : std::nullopt;
}

/// Up to where curves go: what is known stays known.
double plotted_s(const ReportData& data) {
  return std::max(data.files.record.end_s, whole_time_s(data).value_or(0.0));
}

void add_scored(const ReportData& data, SvgPlot& plot) {
  const double end_s = plotted_s(data);
  const auto time = [](const FoundAtTime& f) { return f.t_s; };
  plot.add_steps(
      "within 20 cm (the paper's count)", 1,
      course(data.found, end_s, time, [](const FoundAtTime& f) { return f.detected_paper; }));
  plot.add_steps("within 5 cm", 0,
                 course(data.found, end_s, time, [](const FoundAtTime& f) { return f.detected; }));
  if (const std::optional<int> total = data.files.summary.fruits_total) {
    plot.mark_y(*total, std::to_string(*total) + " fruits");
  }
}

void add_reported(const ReportData& data, SvgPlot& plot) {
  plot.add_steps(
      "", 0,
      course(
          fruit_course(data.files.record), plotted_s(data),
          [](const FruitsAtTime& at) { return at.t_s; },
          [](const FruitsAtTime& at) { return static_cast<double>(at.fruits->size()); }));
}

/// What the lines across the plot are.
std::string line_note(const ReportData& data) {
  std::string note;
  if (!data.files.record.segments.empty()) {
    note = "Dotted lines: where a segment begins, with its number";
    if (whole_time_s(data)) {
      note += "; T: where the mission's time is over. What is found by then counts";
    }
  }
  return note.empty() ? note : "<p class=\"note\">" + note + ".</p>\n";
}

}  // namespace

std::string progress_section(const ReportData& data) {
  if (fruit_course(data.files.record).empty()) return {};
  const bool scored = !data.found.empty();
  SvgPlot plot({"Fruits over mission time", "mission time / s",
                scored ? "fruits found" : "fruits reported"});
  plot.set_y_whole(true);
  plot.include(0.0, 0.0);
  plot.include(plotted_s(data), 1.0);
  scored ? add_scored(data, plot) : add_reported(data, plot);
  for (const SegmentEvent& segment : data.files.record.segments) {
    plot.mark_x(segment.start_s, std::to_string(segment.segment + 1));
  }
  if (const std::optional<double> t_s = whole_time_s(data)) plot.mark_x(*t_s, "T");
  return html_section("Fruits over time", html_plot(plot, 320, 260) + line_note(data));
}

}  // namespace canopeer
