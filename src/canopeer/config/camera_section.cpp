#include "canopeer/config/camera_section.h"

#include "canopeer/config/robot_file.h"
#include "canopeer/geometry/angles.h"

namespace canopeer {
namespace {

constexpr const char* kLabels70 = "labels_70";

/// Field of view and depth range at 640 × 480. D400 family data sheet: the D435 has 75° × 62° at
/// this size and no depth nearer than 0.175 m; of the D405 the middle 640 of 848 columns with 84°.
struct CameraPreset {
  double fov_x_deg;
  double min_range_m, max_range_m;
};

CameraPreset preset_of(const std::string& name) {
  if (name == "d435") return {75.0, 0.175, 3.0};
  if (name == "d405") return {68.4, 0.07, 1.0};
  return {80.0, 0.15, 3.0};
}

void read_intrinsics(YamlMap& camera, CameraIntrinsics& k) {
  const CameraPreset preset =
      preset_of(camera.choice("preset", "paper", {"paper", "d435", "d405"}));
  const int width = camera.integer("width_px", 640, 16, 8192);
  const int height = camera.integer("height_px", 480, 16, 8192);
  const double fov = camera.number("fov_x_deg", preset.fov_x_deg, {1.0, 170.0}) * kDegree;
  k = CameraIntrinsics::from_fov(width, height, fov);
  constexpr double kMost = 1e5;
  k.fx = camera.number("fx_px", k.fx, {1.0, kMost});
  k.fy = camera.number("fy_px", k.fy, {1.0, kMost});
  // In files the centre of the upper left pixel is (0, 0), here it is (0.5, 0.5).
  k.cx = camera.number("cx_px", k.cx - 0.5, {-kMost, kMost}) + 0.5;
  k.cy = camera.number("cy_px", k.cy - 0.5, {-kMost, kMost}) + 0.5;
  k.min_range_m = camera.number("min_range_m", preset.min_range_m, {0.01, 10.0});
  k.max_range_m = camera.number("max_range_m", preset.max_range_m, {0.02, 100.0});
  if (k.min_range_m >= k.max_range_m) {
    camera.complain("max_range_m", "expected more than min_range_m");
  }
}

/// The lens must be invertible at least up to the image's corners.
bool bends_back(const LensDistortion& lens, const CameraIntrinsics& k) {
  for (const int u : {0, k.width / 2, k.width - 1}) {
    for (const int v : {0, k.height / 2, k.height - 1}) {
      const Eigen::Vector2d seen = k.ray(u, v).head<2>();
      const Eigen::Vector2d ideal = lens.undistort(seen);
      if (!((lens.distort(ideal) - seen).norm() < 1e-6)) return true;
      // Past the lens's turning point a second, farther point has the same image.
      if (ideal.norm() > 4.0 * seen.norm() + 1e-9) return true;
    }
  }
  return false;
}

void read_lens(YamlMap& camera, const CameraIntrinsics& k, RgbdSensorOptions& sensor) {
  const auto d = camera.numbers("distortion", {0, 0, 0, 0, 0}, 5, {-100.0, 100.0});
  sensor.lens = {d[0], d[1], d[2], d[3], d[4]};
  sensor.rectify = camera.boolean("rectify", true);
  if (bends_back(sensor.lens, k)) {
    camera.complain("distortion",
                    "expected [k1, k2, p1, p2, k3] of a lens that covers the whole image; this "
                    "one folds back before its corners");
  }
}

/// A duration that files give in milliseconds.
double seconds(YamlMap& map, const char* key_ms, double default_s, double least_ms,
               double most_ms) {
  const double ms = map.number(key_ms, 1000.0 * default_s, {least_ms, most_ms});
  return map.has(key_ms) ? ms / 1000.0 : default_s;
}

void read_motion(YamlMap& camera, CameraMotionOptions& o) {
  o = camera_motion_preset(camera.choice("motion", "none", camera_motion_names()));
  YamlMap m = camera.map("motion_model");
  o.exposure_s = seconds(m, "exposure_ms", o.exposure_s, 0.0, 1e3);
  o.readout_s = seconds(m, "readout_ms", o.readout_s, 0.0, 1e3);
  o.depth_rolls = m.boolean("depth_rolls", o.depth_rolls);
  o.latency_s = seconds(m, "latency_ms", o.latency_s, 0.0, 1e4);
  o.stamp_jitter_s = seconds(m, "stamp_jitter_ms", o.stamp_jitter_s, 0.0, 1e3);
  o.stamp_offset_s = seconds(m, "stamp_offset_ms", o.stamp_offset_s, -1e3, 1e3);
  o.sub_frames = m.integer("sub_frames", o.sub_frames, 1, 255);
  if (auto ok = o.validate(); !ok) camera.complain("motion_model", ok.error().message);
}

}  // namespace

void read_camera(YamlMap camera, MissionFile& mission) {
  SimulationOptions& simulation = mission.simulation;
  read_intrinsics(camera, simulation.camera);
  read_lens(camera, simulation.camera, simulation.sensor);
  if (camera.has("mounting")) mission.T_frame_camera = read_pose(camera.map("mounting"));
  RgbdSensorOptions& sensor = simulation.sensor;
  sensor.hand_eye_translation_m = camera.number("hand_eye_error_m", 0.0, {0.0, 0.2});
  sensor.hand_eye_rotation_rad = camera.number("hand_eye_error_deg", 0.0, {0.0, 45.0}) * kDegree;
  read_motion(camera, sensor.motion);
}

void read_noise(YamlMap& file, RgbdSensorOptions& sensor, DetectorOptions& detector) {
  std::vector<std::string> names = sensor_noise_names();
  names.emplace_back(kLabels70);
  const std::string name = file.choice("noise", "none", names);
  const bool labels_70 = name == kLabels70;
  if (labels_70) detector.kind = "labels";
  SensorNoiseOptions o = sensor_noise_preset(labels_70 ? "none" : name);
  YamlMap m = file.map("noise_model");
  o.baseline_m = m.number("baseline_m", o.baseline_m, {0.0, 1.0});
  o.disparity_noise_px = m.number("disparity_noise_px", o.disparity_noise_px, {0.0, 10.0});
  o.correlation_px = m.number("correlation_px", o.correlation_px, {1.0, 100.0});
  o.disparity_step_px = m.number("disparity_step_px", o.disparity_step_px, {0.0, 10.0});
  o.baseline_shadow = m.boolean("baseline_shadow", o.baseline_shadow);
  o.lateral_px = m.number("lateral_px", o.lateral_px, {0.0, 10.0});
  o.depth_step_m = m.number("depth_step_m", o.depth_step_m, {0.0, 1.0});
  o.lost_below_cosine = m.number("lost_below_cosine", o.lost_below_cosine, {0.0, 1.0});
  o.kept_above_cosine = m.number("kept_above_cosine", o.kept_above_cosine, {0.0, 1.0});
  o.edge_step = m.number("edge_step", o.edge_step, {0.001, 1.0});
  o.lost_at_edge = m.number("lost_at_edge", o.lost_at_edge, {0.0, 1.0});
  o.flying_at_edge = m.number("flying_at_edge", o.flying_at_edge, {0.0, 1.0});
  o.lost_anywhere = m.number("lost_anywhere", o.lost_anywhere, {0.0, 1.0});
  o.color_read = m.number("color_read", o.color_read, {0.0, 255.0});
  o.color_shot = m.number("color_shot", o.color_shot, {0.0, 100.0});
  o.exposure = m.number("exposure", o.exposure, {0.01, 100.0});
  o.exposure_spread = m.number("exposure_spread", o.exposure_spread, {0.0, 1.0});
  if (auto ok = o.validate(); !ok) file.complain("noise_model", ok.error().message);
  sensor.noise = o;
  // Half of the labels wrong is none at all; who writes 0.7 means that many are right.
  sensor.label_noise = file.number("label_noise", labels_70 ? 0.3 : 0.0, {0.0, 0.5});
}

void check_labels(YamlMap& file, const DetectorOptions& detector) {
  const bool blind = detector.kind == "colour" || detector.kind == "network";
  if (blind && file.is_text("noise") && file.text("noise", {}) == kLabels70) {
    file.complain("noise", "labels_70 is of the camera's labels, at which detector '" +
                               detector.kind + "' does not look; expected detector.kind: labels");
  }
}

}  // namespace canopeer
