#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/builtin_interfaces.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/cdr/messages/trajectory_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::control_msgs {

/// 0: the controller's own; negative: none.
struct JointTolerance {
  static constexpr std::string_view kType = "control_msgs/msg/JointTolerance";
  std::string name;
  double position{};
  double velocity{};
  double acceleration{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(name, position, velocity, acceleration);
  }
};

struct JointComponentTolerance {
  static constexpr std::string_view kType = "control_msgs/msg/JointComponentTolerance";
  std::string joint_name;
  std::uint16_t component{};
  double position{};
  double velocity{};
  double acceleration{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(joint_name, component, position, velocity, acceleration);
  }
};

struct FollowJointTrajectory {
  static constexpr std::string_view kType = "control_msgs/action/FollowJointTrajectory";
  struct Goal {
    trajectory_msgs::JointTrajectory trajectory;
    trajectory_msgs::MultiDOFJointTrajectory multi_dof_trajectory;
    std::vector<JointTolerance> path_tolerance;
    std::vector<JointComponentTolerance> component_path_tolerance;
    std::vector<JointTolerance> goal_tolerance;
    std::vector<JointComponentTolerance> component_goal_tolerance;
    builtin_interfaces::Duration goal_time_tolerance;
    template <class Archive>
    void visit(Archive& archive) {
      archive(trajectory, multi_dof_trajectory, path_tolerance, component_path_tolerance,
              goal_tolerance, component_goal_tolerance, goal_time_tolerance);
    }
  };
  struct Result {
    static constexpr std::int32_t SUCCESSFUL = 0;
    static constexpr std::int32_t INVALID_GOAL = -1;
    static constexpr std::int32_t INVALID_JOINTS = -2;
    static constexpr std::int32_t OLD_HEADER_TIMESTAMP = -3;
    static constexpr std::int32_t PATH_TOLERANCE_VIOLATED = -4;
    static constexpr std::int32_t GOAL_TOLERANCE_VIOLATED = -5;
    std::int32_t error_code{};
    std::string error_string;
    template <class Archive>
    void visit(Archive& archive) {
      archive(error_code, error_string);
    }
  };
  /// Written as Humble and Jazzy have it. Read up to `error`: control_msgs 6.3 (June 2025) put an
  /// index behind it, under the same name.
  struct Feedback {
    std_msgs::Header header;
    std::vector<std::string> joint_names;
    trajectory_msgs::JointTrajectoryPoint desired;
    trajectory_msgs::JointTrajectoryPoint actual;
    trajectory_msgs::JointTrajectoryPoint error;
    std::vector<std::string> multi_dof_joint_names;
    trajectory_msgs::MultiDOFJointTrajectoryPoint multi_dof_desired;
    trajectory_msgs::MultiDOFJointTrajectoryPoint multi_dof_actual;
    trajectory_msgs::MultiDOFJointTrajectoryPoint multi_dof_error;
    template <class Archive>
    void visit(Archive& archive) {
      archive(header, joint_names, desired, actual, error);
      if constexpr (!Archive::kReads) {
        archive(multi_dof_joint_names, multi_dof_desired, multi_dof_actual, multi_dof_error);
      }
    }
  };
};

}  // namespace canopeer::ros::control_msgs
