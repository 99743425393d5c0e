#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/builtin_interfaces.h"
#include "canopeer/cdr/messages/unique_identifier_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::action_msgs {

struct GoalInfo {
  static constexpr std::string_view kType = "action_msgs/msg/GoalInfo";
  unique_identifier_msgs::UUID goal_id;
  builtin_interfaces::Time stamp;
  template <class Archive>
  void visit(Archive& archive) {
    archive(goal_id, stamp);
  }
};

struct GoalStatus {
  static constexpr std::string_view kType = "action_msgs/msg/GoalStatus";
  static constexpr std::int8_t STATUS_UNKNOWN = 0;
  static constexpr std::int8_t STATUS_ACCEPTED = 1;
  static constexpr std::int8_t STATUS_EXECUTING = 2;
  static constexpr std::int8_t STATUS_CANCELING = 3;
  static constexpr std::int8_t STATUS_SUCCEEDED = 4;
  static constexpr std::int8_t STATUS_CANCELED = 5;
  static constexpr std::int8_t STATUS_ABORTED = 6;
  GoalInfo goal_info;
  std::int8_t status{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(goal_info, status);
  }
};

struct GoalStatusArray {
  static constexpr std::string_view kType = "action_msgs/msg/GoalStatusArray";
  std::vector<GoalStatus> status_list;
  template <class Archive>
  void visit(Archive& archive) {
    archive(status_list);
  }
};

/// An id of zeros and a stamp of zero mean all goals.
struct CancelGoal {
  static constexpr std::string_view kType = "action_msgs/srv/CancelGoal";
  struct Request {
    GoalInfo goal_info;
    template <class Archive>
    void visit(Archive& archive) {
      archive(goal_info);
    }
  };
  struct Response {
    static constexpr std::int8_t ERROR_NONE = 0;
    static constexpr std::int8_t ERROR_REJECTED = 1;
    static constexpr std::int8_t ERROR_UNKNOWN_GOAL_ID = 2;
    static constexpr std::int8_t ERROR_GOAL_TERMINATED = 3;
    std::int8_t return_code{};
    std::vector<GoalInfo> goals_canceling;
    template <class Archive>
    void visit(Archive& archive) {
      archive(return_code, goals_canceling);
    }
  };
};

}  // namespace canopeer::ros::action_msgs
