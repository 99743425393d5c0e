#pragma once

#include <optional>
#include <span>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/record/run_record.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// How many fruits were found when a frame had been taken in.
struct FoundAtTime {
  double t_s = 0.0;  ///< mission time
  int detected = 0;
  int detected_paper = 0;
};

/// The scores of one run. A value that the run cannot give is null, never invented.
struct RunMetrics {
  int fruits_total = 0;           ///< counted fruits of the scene
  int detected = 0;               ///< optimal one-to-one, centres ≤ 0.05 m
  int detected_paper = 0;         ///< greedy closest-first one-to-one, ≤ 0.20 m
  std::optional<int> ma50;        ///< detected_paper pairs with 1 − |V − V*| / V* > 0.5
  int false_positives = 0;        ///< at 0.05 m
  int false_positives_paper = 0;  ///< at 0.20 m
  /// Mission time of the first frame after which `detected` is at least that share of
  /// fruits_total.
  std::optional<double> time_to_50pct_s;
  std::optional<double> time_to_80pct_s;
  std::optional<double> time_to_90pct_s;
  double auc = 0.0;  ///< mean of detected / fruits_total over the mission time; 0 without fruits
  /// Share of the counted fruits' true surface that was seen; needs the seen surface.
  std::optional<double> roi_surface_coverage;
  std::optional<double> volume_error_mean;    ///< |V − V*| / V* over the `detected` pairs
  std::optional<double> centre_error_mean_m;  ///< over the `detected` pairs
  // Of the `detected` fruits at least half of whose true surface was seen.
  std::optional<int> fruits_half_seen;
  std::optional<double> volume_error_half_seen;
  std::optional<double> centre_error_half_seen_m;
  // Counted fruits at least 30 % of whose true surface was seen, those `detected` among them, and
  // F1: 2 found / (found + such fruits + false_positives). A fruit found though less of it was seen
  // is neither right nor wrong.
  std::optional<int> fruits_seen_30pct;
  std::optional<int> detected_seen_30pct;
  std::optional<double> f1_seen_30pct;  ///< null when there is neither such a fruit nor a false one
  std::optional<PixelHits> pixels;      ///< of all frames together; null: none had labels
  double joint_path_length_rad = 0.0;   ///< Σ|Δq| of all motions
  double motion_time_s = 0.0;           ///< of all motions, transitions included
  double planning_time_s = 0.0;         ///< standing still before views
  int collisions = 0;                   ///< motions with one
  int plant_contacts = 0;               ///< motions that touched a plant not yet seen
  int views = 0;
  std::vector<FoundAtTime> found;  ///< one entry per view
};

/// Scores a run: the counts from the final fruits, the course over time from the fruits known after
/// each view. `coverage`: of each true fruit the share of its surface that was seen (see
/// fruit_coverage()), empty: not known. Errors are means of distances in metres, not of squares;
/// shares are within 0 … 1; without a detected fruit errors are null, never NaN.
[[nodiscard]] RunMetrics compute_metrics(const RunRecord& record,
                                         std::span<const FruitEstimate> fruits,
                                         std::span<const FruitTruth> truth,
                                         std::span<const double> coverage = {});

}  // namespace canopeer
