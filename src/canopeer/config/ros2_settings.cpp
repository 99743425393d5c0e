#include "canopeer/config/ros2_settings.h"

#include <cmath>
#include <utility>

namespace canopeer {
namespace {

/// What is wrong with settings, the first only.
class Ros2Findings {
 public:
  void within(const char* key, double value, double min, double max) {
    if (std::isfinite(value) && value >= min && value <= max) return;
    note(std::string(key) + ": expected a number between " + std::to_string(min) + " and " +
         std::to_string(max));
  }
  void named(const char* key, const std::string& name, const char* why) {
    if (name.empty()) note(std::string(key) + ": is missing" + why);
  }
  void note(std::string text) {
    if (found_.empty()) found_ = std::move(text);
  }
  [[nodiscard]] Expected<void> outcome() const {
    if (found_.empty()) return {};
    return fail("ros2." + found_);
  }

 private:
  std::string found_;
};

void check_arm(const Ros2ArmSettings& arm, Ros2Findings& findings) {
  findings.named("arm.action", arm.action, "");
  if (arm.joint_states.empty()) findings.note("arm.joint_states: expected at least one topic");
  findings.within("arm.rate_hz", arm.rate_hz, 1.0, 1000.0);
  findings.within("arm.speed_scale", arm.speed_scale, 0.01, 1.0);
  findings.within("arm.first_motions", arm.first_motions, 0, 1000);
  findings.within("arm.first_motion_scale", arm.first_motion_scale, 0.01, 1.0);
  findings.within("arm.start_tolerance_rad", arm.start_tolerance_rad, 1e-4, 0.1);
  findings.within("arm.path_tolerance_rad", arm.path_tolerance_rad, 0.0, 3.0);
  findings.within("arm.goal_tolerance_rad", arm.goal_tolerance_rad, 0.0, 1.0);
  findings.within("arm.goal_time_tolerance_s", arm.goal_time_tolerance_s, 0.0, 3600.0);
  findings.within("arm.max_silence_s", arm.max_silence_s, 0.01, 60.0);
  findings.within("arm.max_slowdown", arm.max_slowdown, 1.0, 1e6);
}

void check_camera(const Ros2CameraSettings& camera, Ros2Findings& findings) {
  if (camera.points.empty()) {
    const char* const why = ", or an organised cloud in its place (camera.points)";
    findings.named("camera.color", camera.color, why);
    findings.named("camera.depth", camera.depth, why);
    findings.named("camera.info", camera.info, why);
  }
  if (!camera.confidences.empty()) {
    findings.named("camera.labels", camera.labels, ": camera.confidences is of labels");
  }
  findings.within("camera.min_confidence", camera.min_confidence, 0.0, 1.0);
  findings.within("camera.max_difference_s", camera.max_difference_s, 0.0, 1.0);
  if (camera.pose != "joint_states" && camera.pose != "tf") {
    findings.note("camera.pose: expected joint_states or tf");
  }
  if (camera.pose == "tf") findings.named("camera.world_frame", camera.world_frame, "");
  findings.within("camera.time_offset_s", camera.time_offset_s, -10.0, 10.0);
  findings.within("camera.settle_s", camera.settle_s, 0.0, 60.0);
  findings.within("camera.timeout_s", camera.timeout_s, 0.05, 3600.0);
}

void check_trolley(const Ros2TrolleySettings& trolley, Ros2Findings& findings) {
  using Kind = Ros2TrolleySettings::Kind;
  if (trolley.kind == Kind::trajectory) {
    findings.named("trolley.action", trolley.action, ", which 'trajectory' needs");
  }
  if (trolley.kind == Kind::topics) {
    if (trolley.travel_command.empty() && trolley.lift_command.empty()) {
      findings.note("trolley.travel_command, trolley.lift_command: 'topics' needs one at least");
    }
  }
  if (!trolley.start_m.empty() && trolley.start_m.size() != 2) {
    findings.note("trolley.start_m: expected [travel, lift]");
  }
  for (const double place : trolley.start_m) findings.within("trolley.start_m", place, -1e3, 1e3);
  findings.within("trolley.speed_m_s", trolley.speed_m_s, 1e-3, 10.0);
  findings.within("trolley.tolerance_m", trolley.tolerance_m, 1e-5, 1.0);
  findings.within("trolley.timeout_s", trolley.timeout_s, 0.1, 86400.0);
  findings.within("trolley.manual_tolerance_m", trolley.manual_tolerance_m, 0.0, 2.0);
}

}  // namespace

Expected<void> Ros2Settings::validate() const {
  Ros2Findings findings;
  findings.named("node", node, "");
  findings.named("namespace", ns, " ('/' is none)");
  if (domain) findings.within("domain", *domain, 0, 232);
  findings.within("discovery_s", discovery_s, 0.1, 3600.0);
  check_arm(arm, findings);
  check_camera(camera, findings);
  check_trolley(trolley, findings);
  findings.within("output.map_rate_hz", output.map_rate_hz, 0.0, 100.0);
  findings.within("output.image_rate_hz", output.image_rate_hz, 0.0, 100.0);
  return findings.outcome();
}

}  // namespace canopeer
