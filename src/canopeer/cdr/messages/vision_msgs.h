#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/geometry_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"

// Version 4, as Humble and Jazzy have it.

namespace canopeer::ros::vision_msgs {

struct ObjectHypothesis {
  static constexpr std::string_view kType = "vision_msgs/msg/ObjectHypothesis";
  std::string class_id;
  double score{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(class_id, score);
  }
};

struct ObjectHypothesisWithPose {
  static constexpr std::string_view kType = "vision_msgs/msg/ObjectHypothesisWithPose";
  ObjectHypothesis hypothesis;
  geometry_msgs::PoseWithCovariance pose;
  template <class Archive>
  void visit(Archive& archive) {
    archive(hypothesis, pose);
  }
};

struct BoundingBox3D {
  static constexpr std::string_view kType = "vision_msgs/msg/BoundingBox3D";
  geometry_msgs::Pose center;
  geometry_msgs::Vector3 size;
  template <class Archive>
  void visit(Archive& archive) {
    archive(center, size);
  }
};

struct Detection3D {
  static constexpr std::string_view kType = "vision_msgs/msg/Detection3D";
  std_msgs::Header header;
  std::vector<ObjectHypothesisWithPose> results;
  BoundingBox3D bbox;
  std::string id;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, results, bbox, id);
  }
};

struct Detection3DArray {
  static constexpr std::string_view kType = "vision_msgs/msg/Detection3DArray";
  std_msgs::Header header;
  std::vector<Detection3D> detections;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, detections);
  }
};

}  // namespace canopeer::ros::vision_msgs
