#include "recording_check.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "canopeer/sensing/pose_check.h"

namespace canopeer::app {
namespace {

constexpr std::size_t kPoints = 6000;  // of a frame are enough to compare it
constexpr int kPairs = 8;

std::size_t step_for(std::size_t count) { return std::max<std::size_t>(1, count / kPoints); }

SeenFrom seen_from(const PosedCloud& cloud) {
  SeenFrom seen{{}, cloud.T_world_points};
  const auto& points = cloud.file.cloud.points;
  for (std::size_t i = 0; i < points.size(); i += step_for(points.size())) {
    if (points[i].allFinite()) seen.points.push_back(points[i]);
  }
  return seen;
}

SeenFrom seen_from(const SegmentedFrame& segmented) {
  const RgbdFrame& frame = segmented.frame;
  SeenFrom seen{{}, frame.T_world_camera};
  const auto width = static_cast<std::size_t>(frame.depth.width());
  const auto& depth = frame.depth.pixels();
  for (std::size_t i = 0; i < depth.size(); i += step_for(depth.size())) {
    if (!(depth[i] > 0.0F)) continue;
    const Vec3 ray = frame.intrinsics.ray(static_cast<int>(i % width), static_cast<int>(i / width));
    seen.points.push_back((static_cast<double>(depth[i]) * ray).cast<float>());
  }
  return seen;
}

Expected<SeenFrom> load_seen(const Recording& recording, std::size_t i) {
  const auto observation = recording.load(i);
  if (!observation) return tl::unexpected(observation.error());
  return std::visit([](const auto& seen) { return seen_from(seen); }, *observation);
}

Expected<std::vector<FramePair>> pairs_of(const Recording& recording) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const auto pose = recording.pose(i);
    if (!pose) return std::vector<FramePair>();  // each file says its own
    poses.push_back(*pose);
  }
  std::vector<FramePair> pairs;
  for (const auto& [i, j] : pairs_to_compare(poses, kPairs)) {
    auto a = load_seen(recording, i);
    if (!a) return tl::unexpected(a.error());
    auto b = load_seen(recording, j);
    if (!b) return tl::unexpected(b.error());
    pairs.push_back({*std::move(a), *std::move(b)});
  }
  return pairs;
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(100.0 * share + 0.5)) + " %";
}

/// Many pixels hold the very same depth, far behind all others.
std::string depth_notice(const std::string& name, const DepthImage& depth) {
  constexpr double kShare = 0.02;
  constexpr float kBehind = 1.25F;
  float largest = 0.0F, next = 0.0F;
  std::size_t pixels = 0;
  for (const float d : depth.pixels()) {
    if (d == largest) ++pixels;
    if (d > largest) {
      next = std::exchange(largest, d);
      pixels = 1;
    } else if (d < largest && d > next) {
      next = d;
    }
  }
  const double share = static_cast<double>(pixels) / static_cast<double>(depth.pixels().size());
  if (!(next > 0.0F && largest > kBehind * next && share > kShare)) return {};
  char text[240];
  std::snprintf(text, sizeof text,
                ": %s of the pixels hold exactly %g m, and no other is farther than %g m; if the "
                "camera means no depth by that, write max_depth_m: %g into the camera file",
                percent(share).c_str(), static_cast<double>(largest), static_cast<double>(next),
                static_cast<double>(largest));
  return name + text;
}

}  // namespace

Expected<std::vector<std::string>> check_recording(const Recording& recording) {
  const PoseSource& source = recording.poses();
  std::vector<std::string> notices = source.notices;
  const auto first = recording.load(0);
  if (!first) return tl::unexpected(first.error());
  if (const auto* frame = std::get_if<SegmentedFrame>(&*first)) {
    std::string notice = depth_notice(recording.name(0), frame->frame.depth);
    if (!notice.empty()) notices.push_back(std::move(notice));
  }
  const auto pairs = pairs_of(recording);
  if (!pairs) return tl::unexpected(pairs.error());
  const PoseVerdict verdict = judge_poses(*pairs, source.order_is_said);
  const std::string seen =
      "of what " + std::to_string(verdict.as_read.pairs) + " pairs of frames see in common ";
  const auto only = [&](const std::string& when, double share, const std::string& advice) {
    return fail(source.file.string() + ": the poses fit what was seen only when " + when + ": " +
                seen + percent(share) + " agrees then, and " + percent(verdict.as_read.share) +
                " as they were read (" + source.taken + "); " + advice);
  };
  if (verdict.order_is_wrong()) {
    return only("quaternions are read as qw qx qy qz", verdict.w_first.share,
                "say so in a first line: # timestamp tx ty tz qw qx qy qz");
  }
  if (verdict.left_handed()) {
    return only("they are taken as left-handed", verdict.mirrored.share,
                "say so by a negative fy_px in the camera file, as ICL-NUIM does");
  }
  if (verdict.poses_are_odd()) {
    notices.push_back(source.file.string() + ": the poses do not fit what was seen: " + seen +
                      "only " + percent(verdict.as_read.share) + " agrees (taken: " + source.taken +
                      "); poses must be those of the sensor's own frame (of a camera: x right, y "
                      "down, z forward) in metres, depth unit and intrinsics must be right");
  }
  return notices;
}

}  // namespace canopeer::app
