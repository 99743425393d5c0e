#include <fmt/format.h>

#include <algorithm>

#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

struct Share {
  const char* name;
  const char* css_class;
  double seconds;
};

std::string share_bar(const std::vector<Share>& shares, double total_s) {
  std::string bar = "<div class=\"bar\" aria-hidden=\"true\">";
  std::string key = "<ul class=\"key\">\n";
  for (const Share& share : shares) {
    const double percent = 100.0 * share.seconds / total_s;
    bar +=
        fmt::format("<div class=\"{}\" style=\"width:{:.2f}%\"></div>", share.css_class, percent);
    key += fmt::format("<li><i class=\"{}\"></i>{} {}, {:.0f} %</li>\n", share.css_class,
                       share.name, duration_text(share.seconds), percent);
  }
  return bar + "</div>\n" + key + "</ul>\n";
}

/// "view_cast" → "view cast"
std::string work_label(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return escape_html(name);
}

std::string work_table(const std::vector<WorkItem>& work) {
  if (work.empty()) return {};
  double total_s = 0.0;
  for (const WorkItem& item : work) total_s += item.seconds;
  std::vector<std::vector<std::string>> rows;
  for (const WorkItem& item : work) {
    const double each_us =
        item.count > 0 ? 1e6 * item.seconds / static_cast<double>(item.count) : 0.0;
    rows.push_back({work_label(item.name), count_text(item.count),
                    fmt::format("{:.2f}", item.seconds), fmt::format("{:.2f}", each_us),
                    fmt::format("{:.1f} %", total_s > 0.0 ? 100.0 * item.seconds / total_s : 0.0)});
  }
  return html_table({"Computing, as charged to mission time", "count", "s", "µs each", "share"},
                    rows) +
         "<p class=\"note\">Graph building goes on while the arm moves, so this work is not all "
         "waiting time.</p>\n";
}

/// All of the mission's time, nothing twice.
std::string split_bar(const TimeSplit& t) {
  const double total_s = t.execution_s + t.transitions_s + t.mapping_s + t.planning_s + t.waiting_s;
  if (!(total_s > 0.0)) return {};
  return share_bar({{"moving to views", "b0", t.execution_s},
                    {"between segments", "b1", t.transitions_s},
                    {"standing still to map", "b2", t.mapping_s},
                    {"standing still to plan", "b3", t.planning_s},
                    {"waiting", "b5", t.waiting_s}},
                   total_s);
}

std::string simple_bar(const Summary& s) {
  const double rest_s = std::max(0.0, s.sim_time_s - s.motion_time_s - s.planning_time_s);
  return share_bar({{"moving", "b0", s.motion_time_s},
                    {"standing still to map and plan", "b1", s.planning_time_s},
                    {"the rest", "b5", rest_s}},
                   s.motion_time_s + s.planning_time_s + rest_s);
}

}  // namespace

std::string time_use_section(const ReportData& data) {
  const Summary& s = data.files.summary;
  if (!(s.sim_time_s > 0.0)) return {};
  return html_section("Where the time goes", (s.time ? split_bar(*s.time) : simple_bar(s)) +
                                                 work_table(data.files.record.work));
}

}  // namespace canopeer
