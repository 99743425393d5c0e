#include "canopeer/record/summary.h"

#include <nlohmann/json.hpp>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rank_correlation.h"
#include "canopeer/record/event_json.h"
#include "canopeer/record/fruit_course.h"

namespace canopeer {
namespace {

using event_json::Json;

/// Every field with its key, in the order of the file: writer and reader cannot drift apart.
template <typename AnySummary, typename Visit>
void for_each_field(AnySummary& summary, Visit&& visit) {
  visit("canopeer_version", summary.canopeer_version);
  visit("mission", summary.mission);
  visit("planner", summary.planner);
  visit("seed", summary.seed);
  visit("compute_table", summary.compute_table);
  visit("segments", summary.segments);
  visit("interrupted", summary.interrupted);
  visit("sim_time_s", summary.sim_time_s);
  visit("mission_time_s", summary.mission_time_s);
  visit("wall_time_s", summary.wall_time_s);
  visit("views", summary.views);
  visit("roi_voxels", summary.roi_voxels);
  visit("fruits_reported", summary.fruits_reported);
  visit("fruits_total", summary.fruits_total);
  visit("detected", summary.detected);
  visit("detected_paper", summary.detected_paper);
  visit("ma50", summary.ma50);
  visit("false_positives", summary.false_positives);
  visit("false_positives_paper", summary.false_positives_paper);
  visit("time_to_50pct_s", summary.time_to_50pct_s);
  visit("time_to_80pct_s", summary.time_to_80pct_s);
  visit("time_to_90pct_s", summary.time_to_90pct_s);
  visit("auc", summary.auc);
  visit("roi_surface_coverage", summary.roi_surface_coverage);
  visit("surface_precision", summary.surface_precision);
  visit("surface_recall", summary.surface_recall);
  visit("surface_f1", summary.surface_f1);
  visit("volume_error_mean", summary.volume_error_mean);
  visit("centre_error_mean_m", summary.centre_error_mean_m);
  visit("fruits_half_seen", summary.fruits_half_seen);
  visit("volume_error_half_seen", summary.volume_error_half_seen);
  visit("centre_error_half_seen_m", summary.centre_error_half_seen_m);
  visit("fruits_seen_30pct", summary.fruits_seen_30pct);
  visit("detected_seen_30pct", summary.detected_seen_30pct);
  visit("f1_seen_30pct", summary.f1_seen_30pct);
  visit("pixel_precision", summary.pixel_precision);
  visit("pixel_recall", summary.pixel_recall);
  visit("pixel_iou", summary.pixel_iou);
  visit("frames_fused", summary.frames_fused);
  visit("frames_late", summary.frames_late);
  visit("frames_blurred", summary.frames_blurred);
  visit("frames_alike", summary.frames_alike);
  visit("frames_unread", summary.frames_unread);
  visit("joint_path_length_rad", summary.joint_path_length_rad);
  visit("motion_time_s", summary.motion_time_s);
  visit("planning_time_s", summary.planning_time_s);
  visit("collisions", summary.collisions);
  visit("plant_contacts", summary.plant_contacts);
  visit("time_offset_s", summary.time_offset_s);
  visit("time_offset_se_s", summary.time_offset_se_s);
  visit("hand_eye_translation_m", summary.hand_eye_translation_m);
  visit("hand_eye_rotation_rad", summary.hand_eye_rotation_rad);
  visit("protocol", summary.protocol);
  visit("auc_views", summary.auc_views);
  visit("count_accuracy_pct", summary.count_accuracy_pct);
  visit("volume_ratio_pct", summary.volume_ratio_pct);
  visit("camera_path_length_m", summary.camera_path_length_m);
  visit("time", summary.time);
  visit("gain_correlation_same_space", summary.gain_correlation_same_space);
  visit("ceiling_fruits_share", summary.ceiling_fruits_share);
  visit("ceiling_surface_share", summary.ceiling_surface_share);
  visit("clairvoyant_found_share", summary.clairvoyant_found_share);
  visit("clairvoyant_auc_share", summary.clairvoyant_auc_share);
  visit("best_found_share", summary.best_found_share);
  visit("best_auc_share", summary.best_auc_share);
  visit("sampled_found_gap", summary.sampled_found_gap);
  visit("sampled_auc_gap", summary.sampled_auc_gap);
  visit("certified_found_gap", summary.certified_found_gap);
  visit("certified_auc_gap", summary.certified_auc_gap);
}

template <typename T>
Json json_of(const T& value) {
  return value;
}

template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const std::optional<TimeSplit>& time) {
  return time ? event_json::from(*time) : Json(nullptr);
}

template <typename T>
void read_into(const Json& json, const char* key, T& value) {
  value = json.at(key).get<T>();
}

template <typename T>
void read_into(const Json& json, const char* key, std::optional<T>& value) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) {
    value.reset();
  } else {
    value = found->get<T>();
  }
}

void read_into(const Json& json, const char* key, std::optional<TimeSplit>& time) {
  time.reset();
  const auto found = json.find(key);
  if (found != json.end() && !found->is_null()) time = event_json::to_time(*found);
}

}  // namespace

namespace {

/// Of all frames together; none: no frame had labels.
void score_pixels(const RunRecord& record, RunScores& scores) {
  std::optional<PixelHits> sum;
  const auto add = [&sum](const std::optional<PixelHits>& pixels) {
    if (!pixels) return;
    if (!sum) sum.emplace();
    sum->right += pixels->right;
    sum->wrong += pixels->wrong;
    sum->missed += pixels->missed;
  };
  for (const ViewEvent& view : record.views) add(view.pixels);
  for (const FrameEvent& frame : record.frames) add(frame.pixels);
  if (!sum) return;
  scores.pixel_precision = sum->precision();
  scores.pixel_recall = sum->recall();
  scores.pixel_iou = sum->iou();
}

void add_up_motions(const RunRecord& record, RunScores& scores) {
  for (const MotionEvent& motion : record.motions) {
    scores.joint_path_length_rad += motion.joint_path_rad;
    scores.motion_time_s += motion.duration_s;
    scores.collisions += motion.collision;
    scores.plant_contacts += motion.plant_contact;
    if (motion.camera_path_m) {
      scores.camera_path_length_m =
          scores.camera_path_length_m.value_or(0.0) + *motion.camera_path_m;
    }
    if (!motion.frames) continue;
    const auto count = [](std::optional<int>& sum, int more) { sum = sum.value_or(0) + more; };
    count(scores.frames_fused, motion.frames->fused);
    count(scores.frames_late, motion.frames->late);
    count(scores.frames_blurred, motion.frames->blurred);
    count(scores.frames_alike, motion.frames->alike);
    count(scores.frames_unread, motion.frames->unread);
  }
  for (const ViewEvent& view : record.views) scores.planning_time_s += view.planning_s;
}

/// Whether views that promised more brought more, counted over the same space.
void compare_gains(const RunRecord& record, RunScores& scores) {
  std::vector<double> predicted;
  std::vector<double> realised;
  for (const ViewEvent& view : record.views) {
    if (!view.predicted_gain || !view.realised_in_fan) continue;
    predicted.push_back(*view.predicted_gain);
    realised.push_back(static_cast<double>(*view.realised_in_fan));
  }
  scores.gain_correlation_same_space = rank_correlation(predicted, realised);
}

}  // namespace

Summary summary_of(const RunRecord& record) {
  const RunHeader& header = record.header;
  Summary s;
  s.canopeer_version = header.canopeer_version;
  s.mission = header.mission;
  s.planner = header.planner;
  s.seed = header.seed;
  s.compute_table = header.compute_table;
  s.segments = static_cast<int>(record.segments.size());
  s.interrupted = record.interrupted;
  s.sim_time_s = record.end_s;
  if (header.mission_time_s > 0.0) s.mission_time_s = header.mission_time_s;
  s.views = static_cast<int>(record.views.size());
  if (!record.views.empty()) s.roi_voxels = record.views.back().roi_voxels;
  if (const std::vector<FruitsAtTime> course = fruit_course(record); !course.empty()) {
    s.fruits_reported = static_cast<int>(course.back().fruits->size());
  }
  score_pixels(record, s);
  add_up_motions(record, s);
  compare_gains(record, s);
  s.time = record.time;
  if (!header.protocol.empty()) s.protocol = header.protocol;
  return s;
}

std::string summary_json(const Summary& summary) {
  Json json = Json::object();
  for_each_field(summary, [&](const char* key, const auto& value) { json[key] = json_of(value); });
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Expected<void> write_summary(const std::filesystem::path& path, const Summary& summary) {
  return write_file(path, summary_json(summary));
}

Expected<Summary> read_summary(const std::filesystem::path& path) {
  const Expected<std::string> text = read_file(path);
  if (!text) return fail(text.error().message);
  Summary summary;
  const char* at = "";
  try {
    const Json json = Json::parse(*text);
    for_each_field(summary, [&](const char* key, auto& value) {
      at = key;
      read_into(json, key, value);
    });
  } catch (const Json::parse_error& error) {
    return fail(path.string() + ": " + event_json::reason(error));
  } catch (const Json::exception& error) {
    return fail(path.string() + ": '" + at + "': " + event_json::reason(error));
  }
  return summary;
}

}  // namespace canopeer
