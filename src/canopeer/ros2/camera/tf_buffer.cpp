#include "canopeer/ros2/camera/tf_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "canopeer/dds/names.h"

namespace canopeer::ros {
namespace {

constexpr std::size_t kMostFrames = 2000;
/// Between samples that lie farther apart nobody knows where a frame was; as of joints.
constexpr double kMaxGap_s = 0.5;
/// Publishers overtake each other by milliseconds; by this much only a clock that was set.
constexpr std::int64_t kClockJump = kNanosecondsPerSecond;

/// tf2 takes "/base" for "base".
std::string plain_frame(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

/// Nothing: it has numbers that are none, or no rotation.
std::optional<Pose> pose_in(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& r = transform.rotation;
  const Eigen::Quaterniond rotation(r.w, r.x, r.y, r.z);
  constexpr double kUnit = 0.1;
  if (!std::isfinite(t.x + t.y + t.z) || !(std::abs(rotation.norm() - 1.0) < kUnit)) {
    return std::nullopt;
  }
  Pose pose(rotation.normalized());
  pose.translation() = Vec3(t.x, t.y, t.z);
  return pose;
}

Pose between_poses(const Pose& a, const Pose& b, double share) {
  const Eigen::Quaterniond from(a.linear()), to(b.linear());
  Pose pose(from.slerp(share, to));
  pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
  return pose;
}

std::string exact_seconds(std::int64_t ns) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s", seconds(ns));
  return text;
}

}  // namespace

TfBuffer::TfBuffer(double span_s, std::size_t most_samples)
    : span_(nanoseconds(span_s)), most_samples_(std::max(most_samples, kMostFrames)) {}

TfBuffer::Link& TfBuffer::longest() {
  return std::max_element(links_.begin(), links_.end(),
                          [](const auto& a, const auto& b) {
                            return a.second.samples.size() < b.second.samples.size();
                          })
      ->second;
}

void TfBuffer::forget_oldest(Link& link) {
  link.samples.pop_front();
  --samples_;
}

void TfBuffer::forget_all(Link& link) {
  samples_ -= link.samples.size();
  link.samples.clear();
}

void TfBuffer::add(const tf2_msgs::TFMessage& message, bool is_static) {
  const std::lock_guard lock(mutex_);
  for (const auto& transform : message.transforms) {
    const std::string parent = plain_frame(transform.header.frame_id);
    const std::string child = plain_frame(transform.child_frame_id);
    const auto pose = pose_in(transform.transform);
    const bool has_room = links_.size() < kMostFrames || links_.count(child) > 0;
    const bool named = is_short_name(parent) && is_short_name(child) && parent != child;
    if (!pose || !named || !has_room) {
      ++malformed_;
      continue;
    }
    Link& link = links_[child];
    const Sample sample{stamp_of(transform.header.stamp), *pose};
    if (link.parent != parent || link.is_static || is_static) {
      forget_all(link);
      link = Link{parent, is_static, {}};
    }
    auto& samples = link.samples;
    if (!samples.empty() && sample.stamp <= samples.back().stamp) {
      if (samples.back().stamp - sample.stamp < kClockJump) continue;
      forget_all(link);
    }
    samples.push_back(sample);
    ++samples_;
    while (samples.front().stamp < sample.stamp - span_) forget_oldest(link);
    if (samples_ > most_samples_) forget_oldest(longest());
  }
}

std::int64_t TfBuffer::malformed() const {
  const std::lock_guard lock(mutex_);
  return malformed_;
}

std::vector<std::string> TfBuffer::ancestors(const std::string& frame) const {
  std::vector<std::string> chain = {frame};
  std::set<std::string> seen = {frame};
  for (auto link = links_.find(frame); link != links_.end(); link = links_.find(chain.back())) {
    if (!seen.insert(link->second.parent).second) break;  // a circle
    chain.push_back(link->second.parent);
  }
  return chain;
}

Expected<TfBuffer::Way> TfBuffer::way(const std::string& target, const std::string& source) const {
  const auto known = [&](const std::string& frame) {
    return std::any_of(links_.begin(), links_.end(), [&](const auto& link) {
      return link.first == frame || link.second.parent == frame;
    });
  };
  for (const std::string* frame : {&target, &source}) {
    if (known(*frame)) continue;
    return fail("tf has no frame '" + *frame + "' (" + std::to_string(links_.size()) +
                " frames are known)");
  }
  Way found{ancestors(source), ancestors(target)};
  auto& [up, down] = found;
  for (std::size_t i = 0; i < up.size(); ++i) {
    const auto meeting = std::find(down.begin(), down.end(), up[i]);
    if (meeting == down.end()) continue;
    down.erase(meeting, down.end());
    up.resize(i);
    return found;
  }
  return fail("the tf frames '" + target + "' and '" + source + "' hang in two trees, under '" +
              down.back() + "' and under '" + up.back() + "'");
}

Expected<Pose> TfBuffer::step(const std::string& child, std::optional<Stamp> stamp) const {
  const Link& link = links_.at(child);
  const auto& samples = link.samples;
  if (link.is_static || !stamp) return samples.back().T_parent_child;
  const std::string what = "tf knows '" + child + "' in '" + link.parent + "' only ";
  if (*stamp > samples.back().stamp) {
    return fail(what + "up to " + exact_seconds(*stamp - samples.back().stamp) + " before");
  }
  if (*stamp < samples.front().stamp) {
    return fail(what + "from " + exact_seconds(samples.front().stamp - *stamp) + " after on");
  }
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), *stamp,
                       [](const Sample& sample, Stamp at) { return sample.stamp < at; });
  if (after->stamp == *stamp) return after->T_parent_child;
  const auto before = std::prev(after);
  const std::int64_t gap = after->stamp - before->stamp;
  if (gap > nanoseconds(kMaxGap_s)) {
    return fail("tf says nothing of '" + child + "' in '" + link.parent + "' for " +
                exact_seconds(gap) + ": have it published more often, or as static");
  }
  const double share = static_cast<double>(*stamp - before->stamp) / static_cast<double>(gap);
  return between_poses(before->T_parent_child, after->T_parent_child, share);
}

Expected<Pose> TfBuffer::walk(const std::string& target, const std::string& source,
                              std::optional<Stamp> stamp) const {
  const std::lock_guard lock(mutex_);
  const auto found = way(plain_frame(target), plain_frame(source));
  if (!found) return tl::unexpected(found.error());
  const auto climb = [&](const std::vector<std::string>& frames) -> Expected<Pose> {
    Pose T_top_first = Pose::Identity();
    for (const std::string& frame : frames) {
      const auto T_parent_frame = step(frame, stamp);
      if (!T_parent_frame) return T_parent_frame;
      T_top_first = *T_parent_frame * T_top_first;
    }
    return T_top_first;
  };
  const auto T_top_source = climb(found->up_from_source);
  if (!T_top_source) return T_top_source;
  const auto T_top_target = climb(found->up_from_target);
  if (!T_top_target) return T_top_target;
  return T_top_target->inverse(Eigen::Isometry) * *T_top_source;
}

Expected<Pose> TfBuffer::lookup(const std::string& target, const std::string& source,
                                Stamp stamp) const {
  return walk(target, source, stamp);
}

Expected<Pose> TfBuffer::newest(const std::string& target, const std::string& source) const {
  return walk(target, source, std::nullopt);
}

std::optional<Stamp> TfBuffer::known_until(const std::string& target,
                                           const std::string& source) const {
  const std::lock_guard lock(mutex_);
  const auto found = way(plain_frame(target), plain_frame(source));
  if (!found) return std::nullopt;
  std::optional<Stamp> until;
  for (const auto* frames : {&found->up_from_source, &found->up_from_target}) {
    for (const std::string& frame : *frames) {
      const Link& link = links_.at(frame);
      if (link.is_static) continue;
      until = std::min(until.value_or(link.samples.back().stamp), link.samples.back().stamp);
    }
  }
  return until;
}

bool TfBuffer::has(const std::string& frame) const {
  const auto all = frames();
  return std::binary_search(all.begin(), all.end(), plain_frame(frame));
}

std::vector<std::string> TfBuffer::frames() const {
  const std::lock_guard lock(mutex_);
  std::set<std::string> all;
  for (const auto& [child, link] : links_) all.insert({child, link.parent});
  return {all.begin(), all.end()};
}

}  // namespace canopeer::ros
