#include "canopeer/ros2/check/motion_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>
#include <thread>

#include "canopeer/config/robot_file.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/fusion.h"
#include "canopeer/robot/self_filter.h"
#include "canopeer/ros2/check/look_around.h"
#include "canopeer/ros2/time/figure.h"
#include "canopeer/sensing/frame_agreement.h"

namespace canopeer::ros {
namespace {

const std::string kMotions = "motions";
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// A frame's depth, by when it was taken.
struct DepthThen {
  Stamp stamp = 0;
  CameraIntrinsics intrinsics;
  DepthImage depth;
};

/// Takes frames while the arm moves, in a thread of its own: the camera keeps the last ones only.
class MovingFrames {
 public:
  MovingFrames(CameraFeed& feed, Stamp from)
      : thread_([this, &feed, from](std::stop_token stop) { collect(feed, from, stop); }) {}
  /// What was taken.
  [[nodiscard]] std::vector<DepthThen> end() {
    thread_.request_stop();
    thread_.join();
    return std::move(frames_);
  }

 private:
  static constexpr std::int64_t kApart = 100'000'000;  // ns: more a second tell nothing new
  void collect(CameraFeed& feed, Stamp from, const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      for (TimedFrame& timed : feed.frames_since(from)) {
        from = timed.stamp;
        if (!frames_.empty() && timed.stamp < frames_.back().stamp + kApart) continue;
        frames_.push_back({timed.stamp, timed.frame.intrinsics, std::move(timed.frame.depth)});
      }
    }
  }
  std::vector<DepthThen> frames_;
  std::jthread thread_;  // last: it begins when all is there
};

/// All frames for the estimate.
struct FrameCollection {
  std::vector<DepthThen> still, moving;

  /// Of those from while it moves so many at most, evenly. Times count from the first frame:
  /// doubles do not hold years to a microsecond.
  [[nodiscard]] std::vector<HandEyeFrame> take() {
    constexpr std::size_t kMostMoving = 40;
    const std::size_t step = 1 + moving.size() / kMostMoving;
    const Stamp first = zero();
    std::vector<HandEyeFrame> frames;
    const auto add = [&](DepthThen& frame) {
      frames.push_back({seconds(frame.stamp - first), frame.intrinsics, std::move(frame.depth)});
    };
    for (DepthThen& frame : still) add(frame);
    for (std::size_t i = 0; i < moving.size(); i += step) add(moving[i]);
    return frames;
  }
  [[nodiscard]] Stamp zero() const { return still.front().stamp; }
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

/// Takes a frame where the arm stands.
bool take_still(CheckBench& bench, FrameCollection& frames, Findings& findings) {
  auto timed = bench.camera->feed().capture();
  if (!timed) {
    findings.wrong(kMotions, timed.error().message);
    return false;
  }
  frames.still.push_back({timed->stamp, timed->frame.intrinsics, std::move(timed->frame.depth)});
  return true;
}

/// One motion from where the arm is, and frames of it. False: it did not get there.
bool move_and_watch(CheckBench& bench, const Configuration& to, FrameCollection& frames,
                    Findings& findings) {
  const Stamp began = bench.joints.newest().value_or(0);
  JointPath path;
  path.waypoints = {bench.arm->configuration(), to};
  MovingFrames watch(bench.camera->feed(), began);
  auto outcome = Expected<MotionOutcome>(MotionOutcome());
  if (const auto started = bench.arm->start(path); started) {
    outcome = bench.arm->finish();
  } else {
    outcome = tl::unexpected(started.error());
  }
  for (DepthThen& frame : watch.end()) frames.moving.push_back(std::move(frame));
  if (!outcome || outcome->end != MotionEnd::arrived) {
    findings.wrong(kMotions,
                   "the arm did not arrive: " + (outcome ? outcome->why : outcome.error().message));
    return false;
  }
  return take_still(bench, frames, findings);
}

/// From look to look where the way is free, else by where it began.
std::vector<Configuration> round_trip(const CollisionChecker& checker, const Configuration& home,
                                      const std::vector<Configuration>& looks) {
  std::vector<Configuration> stops;
  for (const Configuration& look : looks) {
    if (!stops.empty() && !checker.edge_free(stops.back(), look)) stops.push_back(home);
    stops.push_back(look);
  }
  stops.push_back(home);
  return stops;
}

std::string pose_residuals(const HandEyeEstimate& estimate, std::size_t still) {
  std::string text;
  for (std::size_t i = 0; i < std::min(still, estimate.frames.size()); ++i) {
    const auto& frame = estimate.frames[i];
    text += (i == 0 ? "" : " ") + (frame.points == 0 ? std::string("-")
                                                     : figure(1e3 * frame.before_m, 1) + ">" +
                                                           figure(1e3 * frame.after_m, 1));
  }
  return text;
}

}  // namespace

void tell_hand_eye(const HandEyeEstimate& estimate, const AssumedCamera& assumed,
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
    const std::string numbers = mounting_text(assumed.T_frame_camera * estimate.T_said_true);
    findings.wrong("hand-eye",
                   "the camera sits " + mounting + " beside its calibrated place; " +
                       (assumed.pose_from_tf ? "move its optical frame in tf by " + numbers
                                             : "in the robot file: camera_mounting: " + numbers));
  } else {
    findings.ok("hand-eye", "right within " + mounting);
  }
  const std::string clock = figure(1e3 * std::abs(estimate.time_offset_s), 1) + " ms (+- " +
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
                       figure(assumed.time_offset_s + estimate.time_offset_s, 3));
  } else {
    findings.ok("time offset", "right within " + clock);
  }
  const std::string residual =
      "surfaces of " + std::to_string(estimate.frames.size()) + " frames disagree by " +
      figure(1e3 * all.before_m, 1) + " mm, with what was found by " +
      figure(1e3 * all.after_m, 1) +
      " mm; where the arm stood, in mm: " + pose_residuals(estimate, assumed.still);
  constexpr double kOdd_m = 0.006;
  if (all.after_m > kOdd_m) {
    findings.notice("residual", residual +
                                    "; neither explains it: did something move, is depth "
                                    "distorted, or is the robot's description another?");
  } else {
    findings.ok("residual", residual);
  }
}

void check_by_moving(CheckBench& bench, int most_looks, Findings& findings) {
  if (bench.settings.dry_run) return findings.notice(kMotions, "none in a dry run");
  auto first = bench.camera->feed().capture();
  if (!first) return findings.wrong(kMotions, first.error().message);
  const Configuration home = bench.arm->configuration();
  const Surroundings around(bench.robot, first->frame, home, bench.sense.now());
  auto looks = looks_around(bench.robot, around.checker(), home);
  constexpr std::size_t kFewLooks = 4;
  if (looks.size() < kFewLooks) {
    return findings.wrong(kMotions, "only " + std::to_string(looks.size()) +
                                        " of the small motions are free here: move the arm to "
                                        "where it has more room, 0.3 to 1 m before something that "
                                        "stands still");
  }
  looks.resize(std::min(looks.size(), static_cast<std::size_t>(most_looks)));
  FrameCollection frames;
  if (!take_still(bench, frames, findings)) return;
  const auto stops = round_trip(around.checker(), home, looks);
  for (const Configuration& stop : stops) {
    if (!move_and_watch(bench, stop, frames, findings)) return;
  }
  findings.ok(kMotions, std::to_string(stops.size()) + " small ones; " +
                            std::to_string(frames.still.size()) + " frames where the arm stood, " +
                            std::to_string(frames.moving.size()) + " while it moved");
  const Stamp zero = frames.zero();
  const std::string frame_id = bench.frame_id();
  const auto pose_at = [&](double time_s) -> std::optional<Pose> {
    const auto pose = bench.camera->feed().pose_at(zero + nanoseconds(time_s), frame_id);
    if (!pose) return std::nullopt;
    return *pose;
  };
  const auto estimate = estimate_hand_eye(frames.take(), pose_at);
  if (!estimate) return findings.notice("hand-eye", estimate.error().message);
  const bool from_tf = bench.settings.camera.pose == "tf";
  tell_hand_eye(*estimate,
                {from_tf ? Pose::Identity() : camera_mounting(bench.robot),
                 bench.settings.camera.time_offset_s, from_tf, frames.still.size()},
                findings);
}

}  // namespace canopeer::ros
