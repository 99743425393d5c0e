#include "canopeer/ros2/check/frame_judgement.h"

#include <cmath>
#include <numbers>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr double kToDegrees = 180.0 / std::numbers::pi;

double width_angle_deg(const CameraIntrinsics& k) {
  return kToDegrees * (std::atan(k.cx / k.fx) + std::atan((k.width - k.cx) / k.fx));
}

double share_with_depth(const DepthImage& depth) {
  std::size_t count = 0;
  for (const float d : depth.pixels()) count += d > 0.0F;
  return static_cast<double>(count) / static_cast<double>(depth.pixels().size());
}

}  // namespace

void judge_frame(const Expected<TimedFrame>& timed, const CameraIntrinsics& planned,
                 Findings& findings) {
  if (!timed) {
    findings.wrong("frame", timed.error().message);
    return;
  }
  const RgbdFrame& frame = timed->frame;
  const double share = share_with_depth(frame.depth);
  const std::string text = std::to_string(frame.depth.width()) + " x " +
                           std::to_string(frame.depth.height()) + ", " + figure(100.0 * share, 0) +
                           " % with depth, decoded in " + figure(1e3 * timed->decoded_s, 1) + " ms";
  constexpr double kLittle = 0.05;
  if (share < kLittle) {
    findings.notice("frame", text + ": hardly any depth between " +
                                 figure(frame.intrinsics.min_range_m) + " and " +
                                 figure(frame.intrinsics.max_range_m) +
                                 " m; is the camera covered, or its depth in other units?");
  } else {
    findings.ok("frame", text);
  }
  const double seen = width_angle_deg(frame.intrinsics), plan = width_angle_deg(planned);
  constexpr double kOff_deg = 3.0;
  const std::string field = "sees " + figure(seen, 1) + " degrees across";
  if (std::abs(seen - plan) > kOff_deg) {
    findings.notice("field of view", field + ", the mission plans with " + figure(plan, 1) +
                                         ": set camera.fov_x_deg (and width_px, height_px) to it");
  } else {
    findings.ok("field of view", field + ", as the mission plans");
  }
}

void judge_tf(const TfBuffer& tf, const RobotModel& robot, const Configuration& q,
              const Ros2CameraSettings& settings, const std::string& frame_id, Findings& findings) {
  const std::string what = "tf";
  const bool needed = settings.pose == "tf";
  const auto complain = [&](const std::string& text) {
    if (needed) findings.wrong(what, text);
    if (!needed)
      findings.notice(what, text + "; poses come from joint states, so it is not needed");
  };
  const std::string& optical = settings.optical_frame.empty() ? frame_id : settings.optical_frame;
  if (tf.frames().empty()) return complain("nobody publishes it");
  if (optical.empty()) return complain("images name no frame: set ros2.camera.optical_frame");
  const auto T_base_optical = tf.newest(settings.world_frame, optical);
  if (!T_base_optical) {
    return complain(T_base_optical.error().message +
                    "; are ros2.camera.world_frame and optical_frame right?");
  }
  const Pose off = robot.T_base_camera(q).inverse(Eigen::Isometry) * *T_base_optical;
  const double metres = off.translation().norm();
  const double degrees = kToDegrees * Eigen::AngleAxisd(Eigen::Matrix3d(off.linear())).angle();
  const std::string text = "'" + optical + "' in '" + settings.world_frame + "' is " +
                           figure(1e3 * metres, 1) + " mm and " + figure(degrees, 2) +
                           " degrees from where the robot file has the camera";
  constexpr double kFar_m = 0.005, kFar_deg = 0.5;
  if (metres < kFar_m && degrees < kFar_deg) {
    findings.ok(what, text);
    return;
  }
  findings.notice(what,
                  text + ": one of them is wrong" +
                      (degrees > 80.0 ? " (is the robot file's camera_frame an optical frame, "
                                        "z forward?)"
                                      : "; --move says which") +
                      ", or world_frame is not the robot's base link");
}

}  // namespace canopeer::ros
