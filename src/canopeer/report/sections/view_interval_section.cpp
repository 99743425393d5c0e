#include <fmt/format.h>

#include <algorithm>

#include "canopeer/report/html_parts.h"
#include "canopeer/report/sections/report_sections.h"
#include "canopeer/report/view_intervals.h"

namespace canopeer {

std::string view_interval_section(const ReportData& data) {
  constexpr std::size_t kMostBoxes = 24;  // more do not fit beside each other
  const std::vector<std::vector<double>> by_segment = view_intervals(data.files.record);
  std::vector<double> all;
  for (const auto& intervals : by_segment)
    all.insert(all.end(), intervals.begin(), intervals.end());
  if (all.empty()) return {};
  SvgPlot plot({"Time between two views", "segment", "time between two views / s"});
  plot.add_box("all", 0, sample_spread(all));
  if (by_segment.size() > 1 && by_segment.size() <= kMostBoxes) {
    for (std::size_t s = 0; s < by_segment.size(); ++s) {
      plot.add_box(std::to_string(data.files.record.segments[s].segment + 1), 5,
                   sample_spread(by_segment[s]));
    }
  }
  std::sort(all.begin(), all.end());
  const std::string figures = fmt::format(
      "<p>Median {:.2f} s, 95 % within {:.2f} s, longest {:.2f} s ({} intervals within "
      "segments).</p>\n",
      quantile(all, 0.5), quantile(all, 0.95), all.back(), all.size());
  return html_section("Time between two views",
                      figures + html_plot(plot, 270, 230) +
                          "<p class=\"note\">Box: quartiles and median. Whiskers: the farthest "
                          "value within 1.5 box lengths. Circles: beyond.</p>\n");
}

}  // namespace canopeer
