#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/record/run_record.h"

namespace canopeer {

/// How good a run was. A figure nobody measured is null, never invented: all that need ground truth
/// are null when there is none. Errors are means of distances, not of squares; shares are within
/// 0 … 1.
struct RunScores {
  std::optional<int> fruits_total;           ///< counted fruits of the ground truth
  std::optional<int> detected;               ///< optimal one-to-one, centres within 0.05 m
  std::optional<int> detected_paper;         ///< greedy closest-first one-to-one, within 0.20 m
  std::optional<int> ma50;                   ///< paper pairs with 1 − |V − V*| / V* > 0.5
  std::optional<int> false_positives;        ///< of `detected`
  std::optional<int> false_positives_paper;  ///< of `detected_paper`
  // Mission time of the first frame after which `detected` is at least that share of
  // fruits_total; null: never.
  std::optional<double> time_to_50pct_s;
  std::optional<double> time_to_80pct_s;
  std::optional<double> time_to_90pct_s;
  /// Mean of detected / fruits_total over the mission time; 0 without fruits. Null where a segment
  /// has no time limit: its end would be the planner's choice.
  std::optional<double> auc;
  std::optional<double> roi_surface_coverage;  ///< share of the counted fruits' surface seen
  std::optional<double> surface_precision;     ///< of fruits.ply against the true fruits, 0.015 m
  std::optional<double> surface_recall;
  std::optional<double> surface_f1;
  std::optional<double> volume_error_mean;    ///< |V − V*| / V* over the `detected` pairs
  std::optional<double> centre_error_mean_m;  ///< over the `detected` pairs
  // Of the `detected` fruits half of whose true surface was seen.
  std::optional<int> fruits_half_seen;
  std::optional<double> volume_error_half_seen;
  std::optional<double> centre_error_half_seen_m;
  // Counted fruits 30 % of whose true surface was seen, those `detected` among them, and F1:
  // 2 found / (found + such fruits + false_positives). A fruit found though less of it was seen is
  // neither right nor wrong; F1 is null when there is neither such a fruit nor a false one.
  std::optional<int> fruits_seen_30pct;
  std::optional<int> detected_seen_30pct;
  std::optional<double> f1_seen_30pct;
  std::optional<double> pixel_precision;  ///< of the detector, over all frames with labels
  std::optional<double> pixel_recall;
  std::optional<double> pixel_iou;

  // Of the frames that came while arm or trolley moved; null: none were wanted.
  std::optional<int> frames_fused;
  std::optional<int> frames_late;     ///< perception was busy
  std::optional<int> frames_blurred;  ///< more than the mission allows
  std::optional<int> frames_alike;    ///< the camera had hardly moved
  std::optional<int> frames_unread;   ///< their images could not be read

  double joint_path_length_rad = 0.0;  ///< Σ|Δq| of all motions
  double motion_time_s = 0.0;          ///< of all motions, transitions included
  double planning_time_s = 0.0;        ///< standing still before views
  int collisions = 0;                  ///< motions with one
  int plant_contacts = 0;              ///< motions that touched a plant not yet seen

  /// Mean of detected / fruits_total over the views a rule gives (RunHeader::views_planned): what
  /// a segment leaves of its views keeps its last count. Null without such a rule.
  std::optional<double> auc_views;
  /// 100 (1 − |n − fruits_total| / fruits_total), n = detected + false_positives: how right the
  /// count is, whichever fruits they are. Fruits reported that do not count (green ones) are left
  /// out. Below 0 when n is more than twice as many.
  std::optional<double> count_accuracy_pct;
  /// 100 Σ V / Σ V* over the `detected` pairs: 100 is best. Fruits not found are in neither sum.
  std::optional<double> volume_ratio_pct;
  std::optional<double> camera_path_length_m;  ///< of all motions, drives included
  std::optional<TimeSplit> time;               ///< where the mission's time went
  /// Spearman's rank correlation of predicted gain and of what was realised of it in the same space
  /// (ViewEvent::realised_in_fan), over the views with a prediction.
  std::optional<double> gain_correlation_same_space;

  // Against a yardstick (yardstick.h); null: none was given, or it does not tell. A share is above
  // 1 where the run is better than that; all but the certified gap may be so.
  std::optional<double> ceiling_fruits_share;   ///< detected / fruits that can be seen at all
  std::optional<double> ceiling_surface_share;  ///< seen of the surface any reachable view can show
  std::optional<double> clairvoyant_found_share;
  std::optional<double> clairvoyant_auc_share;
  std::optional<double> best_found_share;  ///< of the best known
  std::optional<double> best_auc_share;
  // (bound − result) / bound: 0 when nothing more is possible.
  std::optional<double> sampled_found_gap;
  std::optional<double> sampled_auc_gap;
  std::optional<double> certified_found_gap;
  std::optional<double> certified_auc_gap;
};

/// The figures of one run, as `summary.json` holds them, its scores behind the rest. All but
/// `wall_time_s` depend only on mission, options and seed.
struct Summary : RunScores {
  std::string canopeer_version;
  std::string mission;
  std::string planner;
  std::uint64_t seed = 1;
  std::string compute_table;
  int segments = 0;          ///< begun
  bool interrupted = false;  ///< ended before all segments were over
  double sim_time_s = 0.0;
  /// What found and times are counted over, where the mission's clock never stops; null: over
  /// sim_time_s.
  std::optional<double> mission_time_s;
  double wall_time_s = 0.0;
  int views = 0;
  std::int64_t roi_voxels = 0;  ///< distinct ROI voxels in the map at the end
  int fruits_reported = 0;      ///< rows of fruits.csv
  // How far pose and image disagree; null where no frames were taken on the way, or they do not
  // tell it.
  std::optional<double> time_offset_s;     ///< added to stamps of frames gives the poses' clock
  std::optional<double> time_offset_se_s;  ///< standard error of it
  std::optional<double> hand_eye_translation_m;  ///< of the camera beside its said place
  std::optional<double> hand_eye_rotation_rad;
  std::optional<std::string> protocol;  ///< name of the rules; null: the mission's own
};

/// What the record alone tells: all but the scores against the truth, and the wall time.
[[nodiscard]] Summary summary_of(const RunRecord& record);

/// Indented JSON with a newline at the end; the same summary gives the same bytes.
[[nodiscard]] std::string summary_json(const Summary& summary);

[[nodiscard]] Expected<void> write_summary(const std::filesystem::path& path,
                                           const Summary& summary);

/// The error names the file, and the key or position. Unknown keys are skipped, missing ones that
/// may be null are null.
[[nodiscard]] Expected<Summary> read_summary(const std::filesystem::path& path);

}  // namespace canopeer
