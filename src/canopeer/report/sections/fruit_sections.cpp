#include <fmt/format.h>

#include <map>

#include "canopeer/record/fruit_course.h"
#include "canopeer/report/drawing/axis_ticks.h"
#include "canopeer/report/fruits/fruit_map_svg.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

std::string signed_number(double value, int decimals) {
  return AxisTicks{{}, decimals}.label(value);
}

std::string verdict_cell(const FruitVerdict& v, const RunFiles& files) {
  switch (v.verdict) {
    case Verdict::found:
    case Verdict::near:
      return fmt::format("<i class=\"dot d{}\"></i>fruit {}, {:.1f} cm off",
                         v.verdict == Verdict::found ? 0 : 1, files.truth[*v.truth].id,
                         100.0 * v.distance_m);
    case Verdict::green:
      return "<i class=\"dot d3\"></i>a green fruit";
    case Verdict::wrong:
      return "<i class=\"dot d2\"></i>no fruit there";
    case Verdict::unscored:
      break;
  }
  return "–";
}

/// "row west, right, 2.31 m, 1.04 m up".
std::string place_cell(const FruitEstimate& f) {
  if (!f.place) return "–";
  return fmt::format("row {}, {}, {} m, {} m up", escape_html(f.place->row),
                     f.place->side == 'L' ? "left" : "right", signed_number(f.place->along_m, 2),
                     signed_number(f.place->height_m, 2));
}

/// Its number, which leads to the moment it was first known.
std::string fruit_cell(const FruitEstimate& fruit, const std::map<int, FruitsAtTime>& first) {
  const std::string text = std::to_string(fruit.id);
  const auto known = first.find(fruit.id);
  return known == first.end() ? text : html_moment(known->second.t_s, text);
}

}  // namespace

FruitMapInput fruit_map_input(const RunFiles& files) {
  FruitMapInput input{files.fruits, files.truth, {}, {}};
  for (const ViewEvent& view : files.record.views) {
    input.cameras.push_back(view.T_world_camera.translation());
  }
  for (const FrameEvent& frame : files.record.frames) {
    input.on_the_way.push_back(frame.T_world_camera.translation());
  }
  return input;
}

std::string map_section(const ReportData& data) {
  const FruitMapInput input = fruit_map_input(data.files);
  if (input.fruits.empty() && input.truth.empty() && input.cameras.empty()) return {};
  constexpr int kWidePx = 880;
  constexpr int kNarrowPx = 332;
  return html_section(
      "Fruit map",
      fmt::format("<div class=\"wide scroll\">{}</div>\n<div class=\"narrow scroll\">{}</div>\n",
                  fruit_map_svg(input, kWidePx, false), fruit_map_svg(input, kNarrowPx, false)));
}

std::string fruit_list_section(const ReportData& data) {
  const RunFiles& files = data.files;
  const bool scored = !files.truth.empty();
  std::vector<std::string> head = {"Fruit",          "x / m",        "y / m",    "z / m",
                                   "a × b × c / mm", "volume / cm³", "seen / %", "views",
                                   "ripeness",       "confidence",   "row place"};
  if (scored) head.emplace_back("is");
  std::map<int, FruitsAtTime> first;  // where there is a replay to look at
  if (files.replay) first = first_known(fruit_course(files.record));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < files.fruits.size(); ++i) {
    const FruitEstimate& f = files.fruits[i];
    const Vec3 axes_mm = 1e3 * f.semi_axes_m;
    rows.push_back({fruit_cell(f, first), signed_number(f.centre.x(), 3),
                    signed_number(f.centre.y(), 3), signed_number(f.centre.z(), 3),
                    fmt::format("{:.0f} × {:.0f} × {:.0f}", axes_mm.x(), axes_mm.y(), axes_mm.z()),
                    fmt::format("{:.0f} ± {:.0f}", f.volume_cm3, f.volume_sd_cm3),
                    fmt::format("{:.0f}", 100.0 * f.seen_share), count_text(f.views),
                    ripeness_name(f.ripeness), fmt::format("{:.2f}", f.confidence), place_cell(f)});
    if (scored) rows.back().push_back(verdict_cell(data.verdicts[i], files));
  }
  if (rows.empty()) return "<section><p class=\"note\">No fruit was reported.</p></section>\n";
  return html_details(fmt::format("All {} reported fruits", rows.size()), html_table(head, rows));
}

}  // namespace canopeer
