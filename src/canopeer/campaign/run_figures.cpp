#include "canopeer/campaign/run_figures.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "canopeer/base/check.h"
#include "canopeer/campaign/statistics.h"
#include "canopeer/eval/metrics.h"
#include "canopeer/record/yardstick_shares.h"
#include "canopeer/report/sample_spread.h"
#include "canopeer/report/view_intervals.h"

namespace canopeer {
namespace {

using Value = std::optional<double>;

constexpr std::array kFigures = {
    Figure{"detected_paper", "fruits found, 0.20 m", 1, Better::more},
    Figure{"detected", "fruits found, 0.05 m", 1, Better::more},
    Figure{"ma50", "MA50", 1, Better::more},
    Figure{"false_positives", "false, 0.05 m", 1, Better::less},
    Figure{"auc", "AUC (found / all over time)", 3, Better::more},
    Figure{"time_to_50pct_s", "time to 50 % / s", 0, Better::less},
    Figure{"time_to_80pct_s", "time to 80 % / s", 0, Better::less},
    Figure{"time_to_90pct_s", "time to 90 % / s", 0, Better::less},
    Figure{"surface_precision", "surface precision, 0.015 m", 3, Better::more},
    Figure{"surface_recall", "surface recall, 0.015 m", 3, Better::more},
    Figure{"surface_f1", "surface F1, 0.015 m", 3, Better::more},
    Figure{"roi_surface_coverage", "surface seen", 3, Better::more},
    Figure{"volume_error_mean", "volume error", 3, Better::less},
    Figure{"roi_voxels", "distinct ROI voxels", 0, Better::more},
    Figure{"views", "views", 0, Better::neither},
    Figure{"view_interval_median_s", "time between views, median / s", 2, Better::less},
    Figure{"view_interval_95pct_s", "time between views, 95 % / s", 2, Better::less},
    Figure{"joint_path_rad", "joint path / rad", 0, Better::less},
    Figure{"still_share", "share of time standing still", 3, Better::less},
    Figure{"gain_correlation", "predicted and realised gain, rank correlation", 3, Better::more},
    Figure{"gain_ratio", "realised / predicted gain, median", 2, Better::neither},
    Figure{"collisions", "collisions", 1, Better::less},
    Figure{"mission_time_s", "mission time that counts / s", 1, Better::neither},
    Figure{"frames_fused", "frames on the way: taken in", 0, Better::neither},
    Figure{"frames_late", "frames on the way: late", 0, Better::less},
    Figure{"frames_blurred", "frames on the way: too blurred", 0, Better::neither},
    Figure{"auc_views", "AUC over views", 3, Better::more},
    Figure{"count_accuracy_pct", "count accuracy / %", 1, Better::more},
    Figure{"volume_ratio_pct", "volume ratio of fruits found / %", 1, Better::neither},
    Figure{"camera_path_m", "camera path / m", 1, Better::less},
    Figure{"gain_correlation_same_space", "the same over one space, rank correlation", 3,
           Better::more},
    Figure{"time_mapping_s", "time mapping / s", 1, Better::less},
    Figure{"time_planning_s", "time planning / s", 1, Better::less},
    Figure{"time_execution_s", "time moving to views / s", 1, Better::neither},
    Figure{"time_waiting_s", "time waiting / s", 1, Better::less},
    Figure{"time_transitions_s", "time between segments / s", 1, Better::less},
    Figure{"ceiling_fruits_share", "found / fruits that can be seen", 3, Better::more},
    Figure{"ceiling_surface_share", "surface seen / that can be seen", 3, Better::more},
    Figure{"clairvoyant_found_share", "found / clairvoyant's", 3, Better::more},
    Figure{"clairvoyant_auc_share", "AUC / clairvoyant's", 3, Better::more},
    Figure{"best_found_share", "found / most known", 3, Better::more},
    Figure{"best_auc_share", "AUC / best known", 3, Better::more},
    Figure{"sampled_found_gap", "found: gap to the sampled bound", 3, Better::less},
    Figure{"sampled_auc_gap", "AUC: gap to the sampled bound", 3, Better::less},
    Figure{"certified_found_gap", "found: gap to the certified bound", 3, Better::less},
    Figure{"certified_auc_gap", "AUC: gap to the certified bound", 3, Better::less},
};

template <typename T>
Value number(const std::optional<T>& value) {
  return value ? Value(static_cast<double>(*value)) : std::nullopt;
}

/// By the mission's clock: one that never stops, or each segment's own.
double planned_time(const RunRecord& record) {
  if (record.header.mission_time_s > 0.0) return record.header.mission_time_s;
  double sum = 0.0;
  for (const auto& segment : record.segments) sum += segment.end_s - segment.start_s;
  return sum;
}

/// Mission time; without the transitions between segments where each has its own clock.
double counted_time(const RunRecord& record, double t_s) {
  if (record.header.mission_time_s > 0.0) return t_s;
  double sum = 0.0;
  for (const auto& segment : record.segments) {
    sum += std::clamp(t_s, segment.start_s, segment.end_s) - segment.start_s;
  }
  return sum;
}

void add_gains(RunFigures& run) {
  std::vector<double> predicted;
  std::vector<double> realised;
  std::vector<double> ratios;
  for (const auto& [p, r] : run.gains) {
    predicted.push_back(p);
    realised.push_back(r);
    if (p > 0.0) ratios.push_back(r / p);
  }
  run.values[figure_index("gain_correlation")] = rank_correlation(predicted, realised);
  std::sort(ratios.begin(), ratios.end());
  if (!ratios.empty()) run.values[figure_index("gain_ratio")] = quantile(ratios, 0.5);
}

void add_intervals(RunFigures& run) {
  auto sorted = run.intervals_s;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty()) return;
  run.values[figure_index("view_interval_median_s")] = quantile(sorted, 0.5);
  run.values[figure_index("view_interval_95pct_s")] = quantile(sorted, 0.95);
}

void add_summary(const Summary& s, RunFigures& run) {
  const auto set = [&](std::string_view key, Value value) {
    run.values[figure_index(key)] = value;
  };
  set("detected_paper", number(s.detected_paper));
  set("detected", number(s.detected));
  set("ma50", number(s.ma50));
  set("false_positives", number(s.false_positives));
  set("auc", s.auc);
  set("time_to_50pct_s", s.time_to_50pct_s);
  set("time_to_80pct_s", s.time_to_80pct_s);
  set("time_to_90pct_s", s.time_to_90pct_s);
  set("surface_precision", s.surface_precision);
  set("surface_recall", s.surface_recall);
  set("surface_f1", s.surface_f1);
  set("roi_surface_coverage", s.roi_surface_coverage);
  set("volume_error_mean", s.volume_error_mean);
  set("roi_voxels", static_cast<double>(s.roi_voxels));
  set("views", s.views);
  set("joint_path_rad", s.joint_path_length_rad);
  set("collisions", s.collisions);
  set("mission_time_s", s.mission_time_s);
  set("frames_fused", number(s.frames_fused));
  set("frames_late", number(s.frames_late));
  set("frames_blurred", number(s.frames_blurred));
  set("auc_views", s.auc_views);
  set("count_accuracy_pct", s.count_accuracy_pct);
  set("volume_ratio_pct", s.volume_ratio_pct);
  set("camera_path_m", s.camera_path_length_m);
  set("gain_correlation_same_space", s.gain_correlation_same_space);
  if (s.time) {
    set("time_mapping_s", s.time->mapping_s);
    set("time_planning_s", s.time->planning_s);
    set("time_execution_s", s.time->execution_s);
    set("time_waiting_s", s.time->waiting_s);
    set("time_transitions_s", s.time->transitions_s);
  }
  set("ceiling_fruits_share", s.ceiling_fruits_share);
  set("ceiling_surface_share", s.ceiling_surface_share);
  set("clairvoyant_found_share", s.clairvoyant_found_share);
  set("clairvoyant_auc_share", s.clairvoyant_auc_share);
  set("best_found_share", s.best_found_share);
  set("best_auc_share", s.best_auc_share);
  set("sampled_found_gap", s.sampled_found_gap);
  set("sampled_auc_gap", s.sampled_auc_gap);
  set("certified_found_gap", s.certified_found_gap);
  set("certified_auc_gap", s.certified_auc_gap);
}

}  // namespace

std::span<const Figure> figures() { return kFigures; }

std::size_t figure_index(std::string_view key) {
  const auto found = std::find_if(kFigures.begin(), kFigures.end(),
                                  [&](const Figure& figure) { return key == figure.key; });
  CANOPEER_CHECK(found != kFigures.end(), "a figure's key");
  return static_cast<std::size_t>(found - kFigures.begin());
}

RunFigures run_figures(const CampaignJob& job, const RunFiles& files) {
  RunFigures run;
  run.job = job;
  run.values.resize(kFigures.size());
  run.fruits_total = files.summary.fruits_total.value_or(0);
  run.one_clock = files.record.header.mission_time_s > 0.0;
  run.planned_s = planned_time(files.record);
  add_summary(files.summary, run);
  for (const auto& f : compute_metrics(files.record, files.fruits, files.truth).found) {
    run.found.push_back({counted_time(files.record, f.t_s), f.detected_paper, f.detected});
  }
  for (const auto& segment : view_intervals(files.record)) {
    run.intervals_s.insert(run.intervals_s.end(), segment.begin(), segment.end());
  }
  for (const auto& view : files.record.views) {
    if (view.predicted_gain) {
      run.gains.emplace_back(*view.predicted_gain, static_cast<double>(view.realised_gain));
    }
  }
  if (run.planned_s > 0.0) {
    run.values[figure_index("still_share")] = files.summary.planning_time_s / run.planned_s;
  }
  add_intervals(run);
  add_gains(run);
  return run;
}

Expected<RunFigures> read_run_figures(const std::filesystem::path& out, const CampaignJob& job,
                                      const std::filesystem::path& yardstick) {
  auto files = read_run_files(out / job.dir);
  if (!files) return fail(files.error().message);
  if (yardstick.empty()) return run_figures(job, *files);
  const auto read = read_yardstick(yardstick);
  if (!read) return tl::unexpected(read.error());
  const Summary& s = files->summary;
  if (auto ok = check_fits(*read, s.mission, job.protocol, std::nullopt, s.fruits_total); !ok) {
    return fail_in(yardstick.string(), ok.error());
  }
  hold_against(*read, files->summary);
  return run_figures(job, *files);
}

}  // namespace canopeer
