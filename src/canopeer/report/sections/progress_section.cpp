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

void add_scored(const ReportData& data, SvgPlot& plot) {
  const double end_s = data.files.record.end_s;
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
          data.files.record.views, data.files.record.end_s,
          [](const ViewEvent& view) { return view.t_s; },
          [](const ViewEvent& view) { return static_cast<double>(view.fruits.size()); }));
}

}  // namespace

std::string progress_section(const ReportData& data) {
  if (data.files.record.views.empty()) return {};
  const bool scored = !data.found.empty();
  SvgPlot plot({"Fruits over mission time", "mission time / s",
                scored ? "fruits found" : "fruits reported"});
  plot.set_y_whole(true);
  plot.include(0.0, 0.0);
  plot.include(data.files.record.end_s, 1.0);
  scored ? add_scored(data, plot) : add_reported(data, plot);
  for (const SegmentEvent& segment : data.files.record.segments) {
    plot.mark_x(segment.start_s, std::to_string(segment.segment + 1));
  }
  const std::string note =
      data.files.record.segments.empty()
          ? ""
          : "<p class=\"note\">Dotted lines: where a segment begins, with its number.</p>\n";
  return html_section("Fruits over time", html_plot(plot, 320, 260) + note);
}

}  // namespace canopeer
