#include "canopeer/sensing/frame_sample.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canopeer {
namespace {

constexpr double kLookedAt_m = 0.6;        // from the camera, about
constexpr double kMotion_m_s = 0.3;        // worth as much as
constexpr double kTurn_rad = 0.3;          // that
constexpr double kLongestGap_s = 1.0;      // between frames of a stretch
constexpr std::size_t kMostTracked = 128;  // points of a stretch's track

using Kept = FrameSample::Kept;

Vec3 looked_at(const Kept& frame) { return frame.T_world_camera * Vec3(0, 0, kLookedAt_m); }

bool sees(const Kept& frame, const Vec3& p_world) {
  const Vec3 p = frame.T_world_camera.inverse() * p_world;
  const CameraIntrinsics& k = frame.image.intrinsics;
  if (!(p.z() > k.min_range_m)) return false;
  const double u = p.x() / p.z() * k.fx + k.cx, v = p.y() / p.z() * k.fy + k.cy;
  return u >= 0.0 && v >= 0.0 && u < k.width && v < k.height;
}

/// How what it looks at moves by, world axes.
Vec3 passing(const Kept& frame) {
  return frame.T_world_camera.linear() *
         (frame.twist.linear + frame.twist.angular.cross(Vec3(0, 0, kLookedAt_m)));
}

double turn_between(const Kept& a, const Kept& b) {
  return Eigen::AngleAxisd(
             Eigen::Matrix3d(a.T_world_camera.linear().transpose() * b.T_world_camera.linear()))
      .angle();
}

/// How much pairs of frames that look at the same can tell.
double worth_of(const std::vector<Kept>& frames) {
  double motion_m_s = 0.0, turn_rad = 0.0;
  for (std::size_t a = 0; a < frames.size(); ++a) {
    for (std::size_t b = a + 1; b < frames.size(); ++b) {
      if (!sees(frames[a], looked_at(frames[b])) || !sees(frames[b], looked_at(frames[a]))) {
        continue;
      }
      motion_m_s = std::max(motion_m_s, (passing(frames[a]) - passing(frames[b])).norm());
      turn_rad = std::max(turn_rad, turn_between(frames[a], frames[b]));
    }
  }
  return motion_m_s / kMotion_m_s + turn_rad / kTurn_rad;
}

bool shows_something(const DepthImage& depth) {
  constexpr std::ptrdiff_t kShare = 10;  // one pixel in so many
  const auto& pixels = depth.pixels();
  return kShare * std::count_if(pixels.begin(), pixels.end(), [](float d) { return d > 0.0F; }) >=
         static_cast<std::ptrdiff_t>(pixels.size());
}

}  // namespace

void FrameSample::add_still(const RgbdFrame& frame) {
  if (rests_from_s_ && *rests_from_s_ < frame.time_s && !open_.track.empty() &&
      open_.track.back().time_s < *rests_from_s_) {
    open_.track.push_back({*rests_from_s_, frame.T_world_camera, {}});
  }
  add(frame, {}, false);
  Stretch next;
  if (!open_.frames.empty() && open_.frames.back().time_s == frame.time_s) {
    next.frames.push_back(open_.frames.back());
  }
  next.track.push_back({frame.time_s, frame.T_world_camera, {}});
  close();
  open_ = std::move(next);
}

void FrameSample::add_moving(const RgbdFrame& frame, const CameraTwist& twist) {
  ++moving_;
  if (!open_.track.empty()) {
    if (frame.time_s <= open_.track.back().time_s) return;  // perception was behind
    const auto first = std::find_if(open_.frames.begin(), open_.frames.end(),
                                    [](const Kept& kept) { return kept.moving; });
    const bool long_enough =
        first != open_.frames.end() && frame.time_s > first->time_s + options_.longest_s;
    const bool gap = frame.time_s > open_.track.back().time_s + kLongestGap_s;
    if (long_enough || gap || open_.track.size() >= kMostTracked) close();
  }
  add(frame, twist, true);
}

void FrameSample::moves_from(double time_s) {
  if (open_.track.empty()) return;
  TrackPoint rest = open_.track.back();
  if (rest.twist.linear.isZero() && rest.twist.angular.isZero() && rest.time_s < time_s) {
    rest.time_s = time_s;
    open_.track.push_back(rest);
  }
}

void FrameSample::add(const RgbdFrame& frame, const CameraTwist& twist, bool moving) {
  if (rests_from_s_ && *rests_from_s_ < frame.time_s) rests_from_s_.reset();
  open_.track.push_back({frame.time_s, frame.T_world_camera, twist});
  auto& kept = open_.frames;
  if (moving && !kept.empty() && frame.time_s < kept.back().time_s + options_.apart_s) return;
  const int step =
      std::max(1, static_cast<int>(std::lround(frame.intrinsics.fx / options_.focal_length_px)));
  Kept next{frame.time_s, coarse_depth(frame.intrinsics, frame.depth, step), frame.T_world_camera,
            twist, moving};
  if (!shows_something(next.image.depth)) return;
  // Those from the middle of a long way see least of what either end shows.
  const auto most = static_cast<std::size_t>(options_.frames);
  if (kept.size() == most) kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(most / 2));
  kept.push_back(std::move(next));
}

void FrameSample::close() {
  Stretch closed = std::exchange(open_, {});
  const double worth = worth_of(closed.frames);
  if (!(worth > 0.0)) return;
  if (slots_.size() == static_cast<std::size_t>(options_.stretches) &&
      slots_.back().stretches >= slot_stretches_) {
    join_neighbours();
  }
  if (slots_.empty() || slots_.back().stretches >= slot_stretches_) slots_.emplace_back();
  Slot& slot = slots_.back();
  ++slot.stretches;
  if (worth > slot.worth) {
    slot.worth = worth;
    slot.best = std::move(closed);
  }
}

void FrameSample::join_neighbours() {
  std::vector<Slot> joined;
  for (std::size_t i = 0; i < slots_.size(); i += 2) {
    Slot slot = std::move(slots_[i]);
    if (i + 1 < slots_.size()) {
      Slot& next = slots_[i + 1];
      next.stretches += slot.stretches;
      slot.stretches = next.stretches;
      if (next.worth > slot.worth) slot = std::move(next);
    }
    joined.push_back(std::move(slot));
  }
  slots_ = std::move(joined);
  slot_stretches_ *= 2;
}

std::vector<FrameSample::Kept> FrameSample::frames() const {
  std::vector<Kept> frames;
  for (const Slot& slot : slots_) {
    for (const Kept& frame : slot.best.frames) {
      // One at rest ends a stretch and begins the next.
      if (frames.empty() || frames.back().time_s < frame.time_s) frames.push_back(frame);
    }
  }
  return frames;
}

PoseTrack FrameSample::track() const {
  std::vector<TrackPoint> points;
  for (const Slot& slot : slots_) {
    points.insert(points.end(), slot.best.track.begin(), slot.best.track.end());
  }
  return PoseTrack(std::move(points));
}

}  // namespace canopeer
