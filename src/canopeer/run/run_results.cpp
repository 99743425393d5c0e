#include "canopeer/run/run_results.h"

#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/eval/metrics.h"
#include "canopeer/eval/surface_coverage.h"
#include "canopeer/eval/surface_score.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/fruit/fruits_json.h"
#include "canopeer/fruit/surface_files.h"
#include "canopeer/map/octomap_file.h"
#include "canopeer/record/timeline_csv.h"
#include "canopeer/record/yardstick_shares.h"
#include "canopeer/render/overview.h"
#include "canopeer/report/report.h"
#include "canopeer/scene/ground_truth_csv.h"
#include "canopeer/sensing/png.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

RunScores scores_of(const RunRecord& record, const Mission& mission, const Scene& truth) {
  const PointCloud cloud = mission.fruits().cloud();
  RunScores scores = compute_metrics(record, mission.fruits().fruits(), truth.fruits,
                                     fruit_coverage(truth, cloud));
  if (const auto surface = surface_score(truth, cloud.points)) {
    scores.surface_precision = surface->precision;
    scores.surface_recall = surface->recall;
    scores.surface_f1 = surface->f1;
  }
  return scores;
}

/// Writes one file after the other, whatever becomes of those before, and keeps the first error.
class Writing {
 public:
  void operator()(Expected<void> written) {
    if (!written && outcome_) outcome_ = std::move(written);
  }
  [[nodiscard]] const Expected<void>& outcome() const { return outcome_; }

 private:
  Expected<void> outcome_;
};

void write_findings(const fs::path& out, const RunRecord& record, const Mission& mission,
                    Writing& write) {
  const auto& fruits = mission.fruits().fruits();
  write(write_file(out / "fruits.csv", fruits_csv(fruits)));
  write(write_file(out / "fruits.json", fruits_json(fruits)));
  const SurfaceMesh surface = mission.fruits().surface();
  write(write_surface_ply(out / "fruits.ply", surface));
  write(write_surface_glb(out / "fruits.glb", surface));
  write(write_ot(mission.map(), out / "map.ot"));
  write(write_roi_ot(mission.map(), out / "map_roi.ot"));
  write(write_file(out / "timeline.csv", timeline_csv(record)));
}

void write_truth(const fs::path& out, const Scene& truth, Writing& write) {
  write(write_file(out / "ground_truth.csv", ground_truth_csv(truth)));
  std::error_code code;
  fs::create_directories(out / "pictures", code);
  write(write_png(out / "pictures" / "01_row.png", render_overview(truth, 960, 540)));
}

/// Only what the frames do tell.
void add_agreement(const FrameAgreement& agreement, Summary& summary) {
  if (agreement.time_known()) {
    summary.time_offset_s = agreement.estimate->time_offset_s;
    summary.time_offset_se_s = agreement.estimate->time_offset_se_s;
  }
  if (agreement.mounting_known()) {
    summary.hand_eye_translation_m = agreement.estimate->translation_m;
    summary.hand_eye_rotation_rad = agreement.estimate->rotation_rad;
  }
}

}  // namespace

Expected<Summary> write_results(const fs::path& out, const RunRecord& record,
                                const Mission& mission, const Scene* truth,
                                const Yardstick* yardstick,
                                const std::optional<FrameAgreement>& agreement,
                                double wall_time_s) {
  Writing write;
  write_findings(out, record, mission, write);
  Summary summary = summary_of(record);
  summary.roi_voxels = mission.map().roi_voxels();
  summary.fruits_reported = static_cast<int>(mission.fruits().fruits().size());
  if (truth != nullptr) {
    write_truth(out, *truth, write);
    static_cast<RunScores&>(summary) = scores_of(record, mission, *truth);
  }
  if (yardstick != nullptr) hold_against(*yardstick, summary);
  if (agreement) add_agreement(*agreement, summary);
  summary.wall_time_s = wall_time_s;
  write(write_summary(out / "summary.json", summary));
  write(write_report(out));
  if (!write.outcome()) return tl::unexpected(write.outcome().error());
  return summary;
}

}  // namespace canopeer
