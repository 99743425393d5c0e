#include "canopeer/sensing/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/text_lines.h"

namespace canopeer {
namespace {

constexpr char kExpected[] = "expected the 8 numbers `timestamp tx ty tz qx qy qz qw`";

Expected<TimedPose> pose_of(const std::vector<std::string_view>& words) {
  std::array<double, 8> v{};
  if (words.size() != v.size()) {
    return fail(std::string(kExpected) + ", got " + std::to_string(words.size()) + " words");
  }
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto number = to_number(words[i]);
    if (!number || !std::isfinite(*number)) {
      return fail(std::string(kExpected) + ", got \"" + std::string(words[i].substr(0, 40)) + "\"");
    }
    v[i] = *number;
  }
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  // Files have four digits or so; what is farther off is no rotation.
  if (std::abs(q.norm() - 1.0) > 0.05) {
    return fail("the quaternion qx qy qz qw has length " + std::to_string(q.norm()) +
                ", expected 1");
  }
  TimedPose pose;
  pose.time_s = v[0];
  pose.T_world_camera.linear() = q.normalized().toRotationMatrix();
  pose.T_world_camera.translation() = Vec3(v[1], v[2], v[3]);
  return pose;
}

Pose between(const TimedPose& a, const TimedPose& b, double time_s) {
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const Eigen::Quaterniond qa(a.T_world_camera.linear());
  const Eigen::Quaterniond qb(b.T_world_camera.linear());
  Pose pose = Pose::Identity();
  pose.linear() = qa.slerp(share, qb).toRotationMatrix();
  pose.translation() =
      (1.0 - share) * a.T_world_camera.translation() + share * b.T_world_camera.translation();
  return pose;
}

}  // namespace

Expected<Trajectory> Trajectory::read(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path.string());
}

Expected<Trajectory> Trajectory::parse(std::string_view text, const std::string& name) {
  Trajectory trajectory;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const auto words = words_of(*line, " \t,");
    if (words.empty() || words[0][0] == '#') continue;
    const std::string place = name + ":" + std::to_string(lines.number());
    const auto pose = pose_of(words);
    if (!pose) return fail_in(place, pose.error());
    if (!trajectory.poses_.empty() && !(pose->time_s > trajectory.poses_.back().time_s)) {
      return fail(place + ": the time stamp is not later than the one before; sort the lines");
    }
    trajectory.poses_.push_back(*pose);
  }
  if (trajectory.poses_.empty()) {
    return fail(name + ": holds no pose; " + kExpected + " in each line");
  }
  return trajectory;
}

std::optional<Pose> Trajectory::at(double time_s, double max_gap_s) const {
  const auto next =
      std::lower_bound(poses_.begin(), poses_.end(), time_s,
                       [](const TimedPose& pose, double time) { return pose.time_s < time; });
  if (next == poses_.end()) return std::nullopt;
  if (next->time_s == time_s) return next->T_world_camera;
  if (next == poses_.begin() || next->time_s - std::prev(next)->time_s > max_gap_s) {
    return std::nullopt;
  }
  return between(*std::prev(next), *next, time_s);
}

}  // namespace canopeer
