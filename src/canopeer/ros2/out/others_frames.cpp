#include "canopeer/ros2/out/others_frames.h"

#include <cmath>

#include "canopeer/dds/names.h"

namespace canopeer::ros {
namespace {

constexpr std::size_t kMostOthers = 10'000;
constexpr std::chrono::seconds kForgetAfter(10);

/// Nothing for numbers that are no motion.
std::optional<Pose> motion_of(const geometry_msgs::Transform& transform) {
  const auto& [t, r] = transform;
  const Eigen::Quaterniond rotation(r.w, r.x, r.y, r.z);
  const Vec3 translation(t.x, t.y, t.z);
  if (!translation.allFinite() || !(std::abs(rotation.norm() - 1.0) < 0.1)) return std::nullopt;
  Pose T = Pose::Identity();
  T.linear() = rotation.normalized().toRotationMatrix();
  T.translation() = translation;
  return T;
}

}  // namespace

Expected<void> OthersFrames::listen(Node& node) {
  const auto heard_by = [this, us = node.participant().id()](bool is_static) {
    return [this, us, is_static](tf2_msgs::TFMessage&& message, const Guid& writer) {
      if (participant_of(writer) != us) take(message, is_static);
    };
  };
  auto moving = node.subscribe<tf2_msgs::TFMessage>("/tf", kTfQos, heard_by(false));
  if (!moving) return fail_in("/tf", moving.error());
  moving_ = std::move(*moving);
  auto fixed =
      node.subscribe<tf2_msgs::TFMessage>("/tf_static", Qos{true, true, 100}, heard_by(true));
  if (!fixed) return fail_in("/tf_static", fixed.error());
  static_ = std::move(*fixed);
  return {};
}

void OthersFrames::take(const tf2_msgs::TFMessage& message, bool is_static) {
  const std::lock_guard lock(mutex_);
  for (const auto& transform : message.transforms) {
    const auto T = motion_of(transform.transform);
    if (!T || !is_short_name(transform.child_frame_id)) continue;
    if (!is_short_name(transform.header.frame_id)) continue;
    if (heard_.size() >= kMostOthers && !heard_.contains(transform.child_frame_id)) continue;
    heard_[transform.child_frame_id] = {{transform.header.frame_id, *T}, Steady::now(), is_static};
  }
}

OthersFrames::Frames OthersFrames::known() const {
  const std::lock_guard lock(mutex_);
  Frames frames;
  for (const auto& [child, heard] : heard_) {
    if (heard.is_static || Steady::now() - heard.at < kForgetAfter) frames[child] = heard.frame;
  }
  return frames;
}

}  // namespace canopeer::ros
