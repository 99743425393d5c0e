#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/builtin_interfaces.h"
#include "canopeer/cdr/messages/geometry_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::trajectory_msgs {

struct JointTrajectoryPoint {
  static constexpr std::string_view kType = "trajectory_msgs/msg/JointTrajectoryPoint";
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> accelerations;
  std::vector<double> effort;
  builtin_interfaces::Duration time_from_start;
  template <class Archive>
  void visit(Archive& archive) {
    archive(positions, velocities, accelerations, effort, time_from_start);
  }
};

struct JointTrajectory {
  static constexpr std::string_view kType = "trajectory_msgs/msg/JointTrajectory";
  std_msgs::Header header;
  std::vector<std::string> joint_names;
  std::vector<JointTrajectoryPoint> points;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, joint_names, points);
  }
};

struct MultiDOFJointTrajectoryPoint {
  static constexpr std::string_view kType = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
  std::vector<geometry_msgs::Transform> transforms;
  std::vector<geometry_msgs::Twist> velocities;
  std::vector<geometry_msgs::Twist> accelerations;
  builtin_interfaces::Duration time_from_start;
  template <class Archive>
  void visit(Archive& archive) {
    archive(transforms, velocities, accelerations, time_from_start);
  }
};

struct MultiDOFJointTrajectory {
  static constexpr std::string_view kType = "trajectory_msgs/msg/MultiDOFJointTrajectory";
  std_msgs::Header header;
  std::vector<std::string> joint_names;
  std::vector<MultiDOFJointTrajectoryPoint> points;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, joint_names, points);
  }
};

}  // namespace canopeer::ros::trajectory_msgs
