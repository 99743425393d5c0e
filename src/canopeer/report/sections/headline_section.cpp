#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

std::string card(const std::string& value, const std::string& label, const char* css_class = "") {
  return fmt::format("<div class=\"card {}\"><b>{}</b><span>{}</span></div>\n", css_class, value,
                     label);
}

std::string of_total(int count, const std::optional<int>& total) {
  if (!total) return std::to_string(count);
  return fmt::format("{} <small>of {}</small>", count, *total);
}

std::string fruit_cards(const Summary& s) {
  if (!s.detected) return card(std::to_string(s.fruits_reported), "fruits reported", "main");
  std::string cards =
      card(of_total(*s.detected, s.fruits_total), "fruits found, centre within 5 cm", "main");
  if (s.detected_paper) {
    cards += card(of_total(*s.detected_paper, s.fruits_total),
                  "found as the paper counts, within 20 cm");
  }
  if (s.false_positives) {
    cards += card(std::to_string(*s.false_positives), "false positives: no fruit within 5 cm");
  }
  return cards;
}

std::string begun_of_planned(const ReportData& data) {
  const int planned = data.files.record.header.segments;
  const int begun = data.files.summary.segments;
  return begun == planned ? fmt::format("{} segment{}", planned, planned == 1 ? "" : "s")
                          : fmt::format("{} of {} segments", begun, planned);
}

/// What the run was told to do, and why it ended early; empty for most.
std::string interventions(const RunRecord& record) {
  const auto notice = [](const std::string& text) {
    return "<p class=\"notice\">" + escape_html(text) + "</p>\n";
  };
  std::string html;
  for (const SteeringEvent& e : record.steering) {
    std::string said = e.said;
    std::replace(said.begin(), said.end(), '_', ' ');
    html += notice(fmt::format("After {} it was told to {}{}{}.", duration_text(e.t_s), said,
                               e.by.empty() ? "" : " by \u201c" + e.by + "\u201d",
                               e.why.empty() ? "" : ": " + e.why));
  }
  for (const MotionEvent& m : record.motions) {
    if (m.ended == MotionEvent().ended) continue;
    html += notice(fmt::format("After {} the arm did not arrive: {}{}{}.",
                               duration_text(m.start_s + m.duration_s), m.ended,
                               m.why.empty() ? "" : ", ", m.why));
  }
  for (const FaultEvent& e : record.faults) {
    html += notice(fmt::format("After {} it failed: {}.", duration_text(e.t_s), e.message));
  }
  return html;
}

/// How far pose and image disagree, as far as frames on the way tell.
std::vector<std::pair<std::string, std::string>> agreement_figures(const Summary& s) {
  std::vector<std::pair<std::string, std::string>> figures;
  if (s.time_offset_s && s.time_offset_se_s) {
    figures.emplace_back(
        "Stamps of frames off by, as the frames show",
        fmt::format("{:.1f} ms (± {:.1f})", -1e3 * *s.time_offset_s, 3e3 * *s.time_offset_se_s));
  }
  if (s.hand_eye_translation_m && s.hand_eye_rotation_rad) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    figures.emplace_back("Camera beside its said place by",
                         fmt::format("{:.1f} mm, {:.2f}°", 1e3 * *s.hand_eye_translation_m,
                                     *s.hand_eye_rotation_rad / kDegree));
  }
  return figures;
}

using Figures = std::vector<std::pair<std::string, std::string>>;

/// What the run reached of what was possible, as far as somebody gave a yardstick.
Figures yardstick_figures(const Summary& s) {
  Figures figures;
  const auto add = [&](const char* name, const std::optional<double>& share) {
    if (share) figures.emplace_back(name, fmt::format("{:.1f} %", 100.0 * *share));
  };
  add("Of the fruits that can be seen: found", s.ceiling_fruits_share);
  add("Of the surface that can be seen: seen", s.ceiling_surface_share);
  add("Of the clairvoyant's fruits", s.clairvoyant_found_share);
  add("Of the clairvoyant's AUC", s.clairvoyant_auc_share);
  add("Of the most fruits known", s.best_found_share);
  add("Of the best AUC known", s.best_auc_share);
  add("Fruits below the sampled bound", s.sampled_found_gap);
  add("AUC below the sampled bound", s.sampled_auc_gap);
  add("Fruits below the certified bound", s.certified_found_gap);
  add("AUC below the certified bound", s.certified_auc_gap);
  return figures;
}

/// Those that not every run has.
Figures further_figures(const Summary& s) {
  Figures figures;
  const auto add = [&](const char* name, const std::optional<double>& value, const char* unit,
                       int decimals) {
    if (value) figures.emplace_back(name, fmt::format("{:.{}f}{}", *value, decimals, unit));
  };
  if (s.auc_views) {
    figures.emplace_back("Share found, mean over the views",
                         fmt::format("{:.1f} %", 100.0 * *s.auc_views));
  }
  add("Count accuracy", s.count_accuracy_pct, " %", 1);
  add("Volume of the fruits found / true", s.volume_ratio_pct, " %", 1);
  add("Surface recall at 15 mm", s.surface_recall, "", 3);
  add("Surface F1 at 15 mm", s.surface_f1, "", 3);
  add("Camera path length", s.camera_path_length_m, " m", 1);
  add("Predicted and realised gain, rank correlation", s.gain_correlation_same_space, "", 2);
  return figures;
}

}  // namespace

std::string headline_section(const ReportData& data) {
  const Summary& s = data.files.summary;
  std::string html = fmt::format(
      "<header>\n<h1>{}</h1>\n<p class=\"sub\">planner {}{} · seed {} · compute table {} · "
      "canopeer {}</p>\n</header>\n",
      escape_html(s.mission), escape_html(s.planner),
      s.protocol ? " · protocol " + escape_html(*s.protocol) : "", s.seed,
      escape_html(s.compute_table), escape_html(s.canopeer_version));
  if (s.interrupted || data.files.record.interrupted) {
    html += fmt::format(
        "<p class=\"notice\">This run was interrupted after {} ({}). What it had "
        "earned until then is below.</p>\n",
        duration_text(s.sim_time_s), begun_of_planned(data));
  }
  html += interventions(data.files.record);
  html += "<div class=\"cards\">\n" + fruit_cards(s);
  html += card(duration_text(s.sim_time_s),
               "mission time, " + begun_of_planned(data) +
                   (s.mission_time_s ? "; counted: " + duration_text(*s.mission_time_s) : ""));
  html += card(std::to_string(s.views), "views");
  if (s.frames_fused) html += card(std::to_string(*s.frames_fused), "frames taken in on the way");
  html += card(std::to_string(s.collisions), "collisions", s.collisions > 0 ? "bad" : "");
  html += card(std::to_string(s.plant_contacts), "contacts with plant parts not seen before");
  if (s.wall_time_s > 0.0) html += card(duration_text(s.wall_time_s), "computing time of this run");
  return html + "</div>\n";
}

std::string figures_section(const ReportData& data) {
  const Summary& s = data.files.summary;
  const auto seconds = [](const std::optional<double>& t) {
    return t ? duration_text(*t) : std::string("–");
  };
  const auto percent = [](const std::optional<double>& share) {
    return share ? fmt::format("{:.1f} %", 100.0 * *share) : std::string("–");
  };
  const auto count = [](const std::optional<int>& n) {
    return n ? std::to_string(*n) : std::string("–");
  };
  std::vector<std::pair<std::string, std::string>> figures = {
      {"50 % of the fruits found after", seconds(s.time_to_50pct_s)},
      {"80 % after", seconds(s.time_to_80pct_s)},
      {"90 % after", seconds(s.time_to_90pct_s)},
      {"Share found, mean over time (AUC)", percent(s.auc)},
      {"Found with volume accuracy above ½", count(s.ma50)},
      {"False positives at 20 cm", count(s.false_positives_paper)},
      {"Centre error, mean",
       s.centre_error_mean_m ? fmt::format("{:.1f} mm", 1e3 * *s.centre_error_mean_m) : "–"},
      {"Volume error, mean", percent(s.volume_error_mean)},
      {"Fruit surface seen", percent(s.roi_surface_coverage)},
      {"Of fruits seen to 30 %: found",
       s.fruits_seen_30pct && s.detected_seen_30pct
           ? fmt::format("{} of {}", *s.detected_seen_30pct, *s.fruits_seen_30pct)
           : "–"},
      {"F1 of these", s.f1_seen_30pct ? fmt::format("{:.3f}", *s.f1_seen_30pct) : "–"},
      {"ROI voxels at the end", count_text(s.roi_voxels)},
      {"Joint path length", fmt::format("{:.1f} rad", s.joint_path_length_rad)},
      {"Arm and trolley moving", duration_text(s.motion_time_s)},
      {"Standing still to map and plan", duration_text(s.planning_time_s)}};
  for (Figures more : {further_figures(s), yardstick_figures(s), agreement_figures(s)}) {
    figures.insert(figures.end(), more.begin(), more.end());
  }
  std::string html = "<dl>\n";
  for (const auto& [name, value] : figures) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, value);
  }
  return html_section("All figures", html + "</dl>\n");
}

}  // namespace canopeer
