#include "canopeer/record/summary.h"

#include <nlohmann/json.hpp>

#include "canopeer/base/atomic_file.h"
#include "canopeer/record/event_json.h"

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
  visit("joint_path_length_rad", summary.joint_path_length_rad);
  visit("motion_time_s", summary.motion_time_s);
  visit("planning_time_s", summary.planning_time_s);
  visit("collisions", summary.collisions);
  visit("plant_contacts", summary.plant_contacts);
}

template <typename T>
Json json_of(const T& value) {
  return value;
}

template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
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

}  // namespace

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
