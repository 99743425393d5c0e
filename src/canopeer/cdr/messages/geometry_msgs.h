#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::geometry_msgs {

struct Vector3 {
  static constexpr std::string_view kType = "geometry_msgs/msg/Vector3";
  double x{}, y{}, z{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(x, y, z);
  }
};

struct Point {
  static constexpr std::string_view kType = "geometry_msgs/msg/Point";
  double x{}, y{}, z{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(x, y, z);
  }
};

struct Point32 {
  static constexpr std::string_view kType = "geometry_msgs/msg/Point32";
  float x{}, y{}, z{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(x, y, z);
  }
};

struct Quaternion {
  static constexpr std::string_view kType = "geometry_msgs/msg/Quaternion";
  double x{}, y{}, z{}, w{1};
  template <class Archive>
  void visit(Archive& archive) {
    archive(x, y, z, w);
  }
};

struct Pose {
  static constexpr std::string_view kType = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;
  template <class Archive>
  void visit(Archive& archive) {
    archive(position, orientation);
  }
};

struct PoseStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseStamped";
  std_msgs::Header header;
  Pose pose;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, pose);
  }
};

struct PoseArray {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseArray";
  std_msgs::Header header;
  std::vector<Pose> poses;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, poses);
  }
};

/// Rows of x, y, z and the rotations about them.
struct PoseWithCovariance {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseWithCovariance";
  Pose pose;
  std::array<double, 36> covariance{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(pose, covariance);
  }
};

struct Transform {
  static constexpr std::string_view kType = "geometry_msgs/msg/Transform";
  Vector3 translation;
  Quaternion rotation;
  template <class Archive>
  void visit(Archive& archive) {
    archive(translation, rotation);
  }
};

/// Child to `header.frame_id`.
struct TransformStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/TransformStamped";
  std_msgs::Header header;
  std::string child_frame_id;
  Transform transform;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, child_frame_id, transform);
  }
};

struct Twist {
  static constexpr std::string_view kType = "geometry_msgs/msg/Twist";
  Vector3 linear, angular;
  template <class Archive>
  void visit(Archive& archive) {
    archive(linear, angular);
  }
};

}  // namespace canopeer::ros::geometry_msgs
