#include "canopeer/sensing/frame_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace canopeer {
namespace {

constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;
constexpr int kPairs = 150;  // more cost time and tell little
constexpr int kPatches = 1000;

std::string decimal(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string triple(const Vec3& v, int decimals) {
  const Vec3 no_minus_zero = v + Vec3::Zero();
  return "[" + decimal(no_minus_zero.x(), decimals) + ", " + decimal(no_minus_zero.y(), decimals) +
         ", " + decimal(no_minus_zero.z(), decimals) + "]";
}

/// "30.2 ms (± 1.5)", at three standard errors: what is called wrong lies beyond.
std::string with_error(double value, double standard_error, int decimals, const char* unit) {
  return decimal(value, decimals) + " " + unit + " (± " + decimal(3.0 * standard_error, decimals) +
         ")";
}

std::string time_text(const HandEyeEstimate& e, const AssumedMounting& assumed) {
  if (!e.time_known) {
    return "they do not tell whether their stamps are right: too few show the same from while the "
           "camera moved otherwise";
  }
  const std::string by =
      with_error(1e3 * std::abs(e.time_offset_s), 1e3 * e.time_offset_se_s, 1, "ms");
  if (!e.time_wrong) return "their stamps are right within " + by;
  return "they are stamped " + by + (e.time_offset_s > 0.0 ? " too early" : " too late") +
         " by the clock of the poses: add " + decimal(e.time_offset_s, 3) +
         " s to the stamps (on ROS 2: ros2.camera.time_offset_s: " +
         decimal(assumed.time_offset_s + e.time_offset_s, 3) + ")";
}

std::string mounting_verdict(const HandEyeEstimate& e, const AssumedMounting& assumed) {
  if (!e.hand_eye_known) {
    return "they do not tell whether the camera sits where the robot file has it: it turned too "
           "little about what it saw";
  }
  const std::string by =
      with_error(1e3 * e.translation_m, 1e3 * e.translation_se_m, 1, "mm") + " and " +
      with_error(kDegreesPerRad * e.rotation_rad, kDegreesPerRad * e.rotation_se_rad, 2, "degrees");
  if (!e.hand_eye_wrong) return "the camera sits where the robot file has it, within " + by;
  return "the camera sits " + by + " beside where the robot file has it: camera_mounting: " +
         mounting_text(assumed.T_frame_camera * e.T_said_true);
}

}  // namespace

std::string mounting_text(const Pose& T_frame_camera) {
  const Eigen::Matrix3d R = T_frame_camera.linear();
  // About fixed x, y, z.
  const Vec3 angles(std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
                    std::atan2(R(1, 0), R(0, 0)));
  return "{xyz_m: " + triple(T_frame_camera.translation(), 4) +
         ", rpy_deg: " + triple(kDegreesPerRad * angles, 2) + "}";
}

FrameAgreement judge_agreement(const FrameSample& sample) {
  FrameAgreement agreement;
  std::vector<HandEyeFrame> frames;
  for (FrameSample::Kept& kept : sample.frames()) {
    agreement.moving += kept.moving;
    frames.push_back({kept.time_s, kept.image.intrinsics, std::move(kept.image.depth)});
  }
  agreement.frames = static_cast<int>(frames.size());
  const PoseTrack track = sample.track();
  HandEyeOptions options;
  options.max_pairs = kPairs;
  options.patches = kPatches;
  auto estimate = estimate_hand_eye(
      frames, [&](double time_s) { return track.at(time_s); }, options);
  if (estimate) {
    agreement.estimate = *std::move(estimate);
  } else {
    agreement.why_not = estimate.error().message;
  }
  return agreement;
}

std::string agreement_text(const FrameAgreement& agreement, const AssumedMounting& assumed) {
  const std::string who = "pose and image of " + std::to_string(agreement.frames) + " frames (" +
                          std::to_string(agreement.moving) + " on the way) ";
  if (!agreement.estimate) return who + "cannot be compared: they have too little in common";
  const HandEyeEstimate& e = *agreement.estimate;
  const std::string verdict = agreement.wrong() ? "disagree: "
                              : e.time_known && e.hand_eye_known
                                  ? "agree: "
                                  : "do not disagree as far as can be told: ";
  return who + verdict + time_text(e, assumed) + "; " + mounting_verdict(e, assumed);
}

}  // namespace canopeer
