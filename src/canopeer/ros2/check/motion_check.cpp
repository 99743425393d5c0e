#include "canopeer/ros2/check/motion_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/map/distance_field.h"
#include "canopeer/map/fusion.h"
#include "canopeer/robot/self_filter.h"
#include "canopeer/ros2/check/look_around.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

const std::string kMotions = "motions";
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Frames for the estimate, with where the camera was said to be.
class FrameCollection {
 public:
  void add(TimedFrame&& timed) {
    frames_.push_back({seconds(timed.stamp - zero(timed.stamp)), timed.frame.intrinsics,
                       std::move(timed.frame.depth)});
  }
  /// Of frames from while it moves, at most so many are kept, evenly.
  void add_moving(std::vector<TimedFrame>&& moving) {
    for (TimedFrame& timed : moving) moving_.push_back(std::move(timed));
    while (moving_.size() > kMostMoving) {
      std::vector<TimedFrame> half;
      for (std::size_t i = 0; i < moving_.size(); i += 2) half.push_back(std::move(moving_[i]));
      moving_ = std::move(half);
    }
  }
  std::vector<HandEyeFrame> take() {
    for (TimedFrame& timed : moving_) add(std::move(timed));
    moving_.clear();
    return std::move(frames_);
  }
  [[nodiscard]] std::size_t still() const { return frames_.size(); }
  [[nodiscard]] std::size_t moving() const { return moving_.size(); }
  [[nodiscard]] Stamp zero() const { return zero_.value_or(0); }

 private:
  static constexpr std::size_t kMostMoving = 60;
  Stamp zero(Stamp first) {
    if (!zero_) zero_ = first;
    return *zero_;
  }
  std::optional<Stamp> zero_;  // times count from it: doubles do not hold years to a microsecond
  std::vector<HandEyeFrame> frames_;
  std::vector<TimedFrame> moving_;
};

/// What the first frame shows, to keep clear of.
class Surroundings {
 public:
  Surroundings(const RobotModel& robot, RgbdFrame frame, const Configuration& q,
               const TrolleyState& trolley)
      : map_(VoxelMapOptions{kVoxel_m}),
        field_(DistanceFieldOptions{around(frame.T_world_camera)}, kVoxel_m),
        checker_(robot, trolley) {
    SelfFilter(robot).mask(frame, q, trolley);
    static_cast<void>(fuse(map_, frame, Mask()));
    field_.rebuild(map_);
    checker_.set_map(&field_);
  }
  [[nodiscard]] const CollisionChecker& checker() const { return checker_; }

 private:
  static constexpr double kVoxel_m = 0.02;
  static Box around(const Pose& T_world_camera) {
    const Vec3 reach = Vec3::Constant(2.0);
    return {T_world_camera.translation() - reach, T_world_camera.translation() + reach};
  }
  VoxelMap map_;
  DistanceField field_;
  CollisionChecker checker_;
};

/// One motion from where the arm is; frames of it are collected. False: it did not get there.
bool move_and_watch(CheckBench& bench, const Configuration& to, FrameCollection& frames,
                    Findings& findings) {
  const Stamp before = bench.joints.newest().value_or(0);
  JointPath path;
  path.waypoints = {bench.arm->configuration(), to};
  const auto started = bench.arm->start(path);
  if (!started) {
    findings.wrong(kMotions, started.error().message);
    return false;
  }
  const auto outcome = bench.arm->finish();
  const std::string why = outcome ? outcome->why : outcome.error().message;
  if (!outcome || outcome->end != MotionEnd::arrived) {
    findings.wrong(kMotions, "the arm did not arrive: " + why);
    return false;
  }
  std::vector<TimedFrame> moving = bench.camera->feed().frames_since(before);
  const auto still_since = bench.joints.still_since(2e-3);
  std::erase_if(moving, [&](const TimedFrame& f) { return still_since && f.stamp > *still_since; });
  frames.add_moving(std::move(moving));
  auto frame = bench.camera->feed().capture();
  if (!frame) {
    findings.wrong(kMotions, frame.error().message);
    return false;
  }
  frames.add(std::move(*frame));
  return true;
}

std::string pose_residuals(const HandEyeEstimate& estimate) {
  std::string text;
  for (std::size_t i = 0; i < estimate.frames.size(); ++i) {
    const auto& frame = estimate.frames[i];
    text += (i == 0 ? "" : " ") + (frame.points == 0 ? std::string("-")
                                                     : figure(1e3 * frame.before_m, 1) + ">" +
                                                           figure(1e3 * frame.after_m, 1));
  }
  return text;
}

std::string vector_text(const Vec3& v, int decimals) {
  return "[" + figure(v.x(), decimals) + ", " + figure(v.y(), decimals) + ", " +
         figure(v.z(), decimals) + "]";
}

/// About fixed x, y, z, as robot files have it.
Vec3 fixed_angles_deg(const Eigen::Matrix3d& R) {
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  return kDegrees * Vec3(std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0)));
}

}  // namespace

void tell_hand_eye(const HandEyeEstimate& estimate, double time_offset_s, bool from_tf,
                   Findings& findings) {
  const auto& all = estimate.all;
  const std::string mounting = figure(1e3 * estimate.translation_m, 1) + " mm (+- " +
                               figure(3e3 * estimate.translation_se_m, 1) + ") and " +
                               figure(kDegrees * estimate.rotation_rad, 2) + " degrees (+- " +
                               figure(3.0 * kDegrees * estimate.rotation_se_rad, 2) + ")";
  if (!estimate.hand_eye_known) {
    findings.notice("hand-eye",
                    "the frames do not tell it: the camera could not turn about two "
                    "axes, or sees too little; start elsewhere");
  } else if (estimate.hand_eye_wrong) {
    findings.wrong(
        "hand-eye",
        "the camera sits " + mounting + " beside its calibrated place: put translation " +
            vector_text(estimate.T_said_true.translation(), 4) + " m and rotation " +
            vector_text(fixed_angles_deg(estimate.T_said_true.linear()), 2) +
            " degrees (about x, y, z of its optical frame) behind " +
            (from_tf ? "the transform that tf has for it" : "camera_mounting in the robot file"));
  } else {
    findings.ok("hand-eye", "right within " + mounting);
  }
  const std::string clock = figure(1e3 * estimate.time_offset_s, 1) + " ms (+- " +
                            figure(3e3 * estimate.time_offset_se_s, 1) + ")";
  if (!estimate.time_known) {
    findings.notice("time offset",
                    "the frames do not tell it: too few from while the arm moved; a "
                    "higher frame rate or speed_scale helps");
  } else if (estimate.time_wrong) {
    findings.wrong("time offset",
                   "images are stamped " + clock +
                       (estimate.time_offset_s > 0.0 ? " too early" : " too late") +
                       " by the clock of joint states: set ros2.camera.time_offset_s to " +
                       figure(time_offset_s + estimate.time_offset_s, 3));
  } else {
    findings.ok("time offset", "right within " + clock);
  }
  const std::string residual = "surfaces of " + std::to_string(estimate.frames.size()) +
                               " frames disagree by " + figure(1e3 * all.before_m, 1) +
                               " mm, with what was found by " + figure(1e3 * all.after_m, 1) +
                               " mm; each, in mm: " + pose_residuals(estimate);
  constexpr double kOdd_m = 0.006;
  if (all.after_m > kOdd_m) {
    findings.notice("residual", residual +
                                    "; neither explains it: did something move, is depth "
                                    "distorted, or is the robot's description another?");
  } else {
    findings.ok("residual", residual);
  }
}

void check_by_moving(CheckBench& bench, Findings& findings) {
  if (bench.settings.dry_run) {
    findings.notice(kMotions, "none in a dry run");
    return;
  }
  if (!bench.arm->ready()) {
    findings.wrong(kMotions, "there is nobody to move the arm");
    return;
  }
  FrameCollection frames;
  auto first = bench.camera->feed().capture();
  if (!first) {
    findings.wrong(kMotions, first.error().message);
    return;
  }
  const Configuration home = bench.arm->configuration();
  const Surroundings around(bench.robot, first->frame, home, bench.sense.now());
  frames.add(std::move(*first));
  const auto looks = looks_around(bench.robot, around.checker(), home);
  constexpr std::size_t kFewLooks = 4;
  if (looks.size() < kFewLooks) {
    findings.wrong(kMotions, "only " + std::to_string(looks.size()) +
                                 " of the small motions are free here: move the arm to where it "
                                 "has more room, 0.3 to 1 m before something that stands still");
    return;
  }
  std::size_t done = 0;
  for (const Configuration& look : looks) {
    if (!move_and_watch(bench, look, frames, findings)) break;
    if (!move_and_watch(bench, home, frames, findings)) break;
    ++done;
  }
  if (done < looks.size()) return;  // said already
  findings.ok(kMotions, std::to_string(2 * done) + " small ones; " +
                            std::to_string(frames.still()) + " frames where the arm stood, " +
                            std::to_string(frames.moving()) + " while it moved");
  const Stamp zero = frames.zero();
  const std::string frame_id = bench.frame_id();
  const auto estimate = estimate_hand_eye(frames.take(), [&](double time_s) -> std::optional<Pose> {
    const auto pose = bench.camera->feed().pose_at(zero + nanoseconds(time_s), frame_id);
    if (!pose) return std::nullopt;
    return *pose;
  });
  if (!estimate) {
    findings.notice("hand-eye", estimate.error().message);
    return;
  }
  tell_hand_eye(*estimate, bench.settings.camera.time_offset_s, bench.settings.camera.pose == "tf",
                findings);
}

}  // namespace canopeer::ros
