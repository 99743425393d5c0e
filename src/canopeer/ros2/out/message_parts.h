#pragma once

#include <string>

#include "canopeer/cdr/messages/geometry_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/ros2/time/stamp.h"
#include "canopeer/sensing/image.h"

// What many messages are made of.

namespace canopeer::ros {

[[nodiscard]] inline std_msgs::Header header_of(const std::string& frame, Stamp stamp) {
  return {ros_time(stamp), frame};
}
[[nodiscard]] inline geometry_msgs::Point point_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
[[nodiscard]] inline geometry_msgs::Vector3 vector_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline geometry_msgs::Quaternion quaternion_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {q.x(), q.y(), q.z(), q.w()};
}
[[nodiscard]] inline geometry_msgs::Pose pose_of(const Pose& T) {
  return {point_of(T.translation()), quaternion_of(T.linear())};
}
[[nodiscard]] inline geometry_msgs::Transform transform_of(const Pose& T) {
  return {vector_of(T.translation()), quaternion_of(T.linear())};
}
[[nodiscard]] inline std_msgs::ColorRGBA color_of(const Rgb& color, float alpha = 1.0F) {
  return {static_cast<float>(color.r) / 255.0F, static_cast<float>(color.g) / 255.0F,
          static_cast<float>(color.b) / 255.0F, alpha};
}

}  // namespace canopeer::ros
