#include "run_results.h"

#include <cstdio>

#include "canopeer/base/atomic_file.h"
#include "canopeer/eval/metrics.h"
#include "canopeer/eval/surface_coverage.h"
#include "canopeer/eval/surface_score.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/fruit/fruits_json.h"
#include "canopeer/fruit/surface_files.h"
#include "canopeer/map/octomap_file.h"
#include "canopeer/record/timeline_csv.h"
#include "canopeer/render/overview.h"
#include "canopeer/report/report.h"
#include "canopeer/scene/ground_truth_csv.h"
#include "canopeer/sensing/png.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

Summary summarize(const RunHeader& header, const Mission& mission, const RunMetrics& metrics) {
  const RunRecord& record = mission.record();
  Summary s;
  s.canopeer_version = header.canopeer_version;
  s.mission = header.mission;
  s.planner = header.planner;
  s.seed = header.seed;
  s.compute_table = header.compute_table;
  s.segments = static_cast<int>(record.segments.size());
  s.interrupted = record.interrupted;
  s.sim_time_s = record.end_s;
  s.views = static_cast<int>(record.views.size());
  s.roi_voxels = mission.map().roi_voxels();
  s.fruits_reported = static_cast<int>(mission.fruits().fruits().size());
  s.fruits_total = metrics.fruits_total;
  s.detected = metrics.detected;
  s.detected_paper = metrics.detected_paper;
  s.ma50 = metrics.ma50;
  s.false_positives = metrics.false_positives;
  s.false_positives_paper = metrics.false_positives_paper;
  s.time_to_50pct_s = metrics.time_to_50pct_s;
  s.time_to_80pct_s = metrics.time_to_80pct_s;
  s.time_to_90pct_s = metrics.time_to_90pct_s;
  s.auc = metrics.auc;
  s.roi_surface_coverage = metrics.roi_surface_coverage;
  s.volume_error_mean = metrics.volume_error_mean;
  s.centre_error_mean_m = metrics.centre_error_mean_m;
  s.fruits_half_seen = metrics.fruits_half_seen;
  s.volume_error_half_seen = metrics.volume_error_half_seen;
  s.centre_error_half_seen_m = metrics.centre_error_half_seen_m;
  s.fruits_seen_30pct = metrics.fruits_seen_30pct;
  s.detected_seen_30pct = metrics.detected_seen_30pct;
  s.f1_seen_30pct = metrics.f1_seen_30pct;
  if (metrics.pixels) {
    s.pixel_precision = metrics.pixels->precision();
    s.pixel_recall = metrics.pixels->recall();
    s.pixel_iou = metrics.pixels->iou();
  }
  s.joint_path_length_rad = metrics.joint_path_length_rad;
  s.motion_time_s = metrics.motion_time_s;
  s.planning_time_s = metrics.planning_time_s;
  s.collisions = metrics.collisions;
  s.plant_contacts = metrics.plant_contacts;
  return s;
}

Expected<void> write_data(const fs::path& out, const Mission& mission, const Scene& scene) {
  if (auto ok = write_file(out / "fruits.csv", fruits_csv(mission.fruits().fruits())); !ok)
    return ok;
  if (auto ok = write_file(out / "fruits.json", fruits_json(mission.fruits().fruits())); !ok)
    return ok;
  const SurfaceMesh surface = mission.fruits().surface();
  if (auto ok = write_surface_ply(out / "fruits.ply", surface); !ok) return ok;
  if (auto ok = write_surface_glb(out / "fruits.glb", surface); !ok) return ok;
  if (auto ok = write_ot(mission.map(), out / "map.ot"); !ok) return ok;
  if (auto ok = write_roi_ot(mission.map(), out / "map_roi.ot"); !ok) return ok;
  if (auto ok = write_file(out / "timeline.csv", timeline_csv(mission.record())); !ok) return ok;
  if (auto ok = write_file(out / "ground_truth.csv", ground_truth_csv(scene)); !ok) return ok;
  std::error_code code;
  fs::create_directories(out / "pictures", code);
  return write_png(out / "pictures" / "01_row.png", render_overview(scene, 960, 540));
}

}  // namespace

Expected<Summary> write_results(const fs::path& out, const RunHeader& header,
                                const Mission& mission, const Scene& scene, double wall_time_s) {
  if (auto ok = write_data(out, mission, scene); !ok) return tl::unexpected(ok.error());
  const RunMetrics metrics =
      compute_metrics(mission.record(), mission.fruits().fruits(), scene.fruits,
                      fruit_coverage(scene, mission.fruits().cloud()));
  Summary summary = summarize(header, mission, metrics);
  if (const auto surface = surface_score(scene, mission.fruits().cloud().points)) {
    summary.surface_precision = surface->precision;
    summary.surface_recall = surface->recall;
    summary.surface_f1 = surface->f1;
  }
  summary.wall_time_s = wall_time_s;
  if (auto ok = write_summary(out / "summary.json", summary); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = write_report(out); !ok) return tl::unexpected(ok.error());
  return summary;
}

void print_summary(const Summary& s, const fs::path& out) {
  std::printf(
      "fruits found      %d of %d within 5 cm (%d as the paper counts), %d false\n"
      "views             %d in %.0f s of mission time (%.1f s of wall time)\n"
      "collisions        %d, motions that touched unseen leaves %d\n"
      "report            %s\n",
      s.detected.value_or(0), s.fruits_total.value_or(0), s.detected_paper.value_or(0),
      s.false_positives.value_or(0), s.views, s.sim_time_s, s.wall_time_s, s.collisions,
      s.plant_contacts, (out / "report.html").c_str());
}

}  // namespace canopeer::app
