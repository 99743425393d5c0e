#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "canopeer/cdr/messages/action_msgs.h"

// What ROS makes of an action type `A` (A::Goal, A::Result, A::Feedback): two services and a
// message.

namespace canopeer::ros {

using unique_identifier_msgs::UUID;

namespace action_names {

/// Two texts in one, when the program is compiled.
template <const std::string_view& First, const std::string_view& Second>
struct Joined {
  static constexpr auto kLetters = [] {
    std::array<char, First.size() + Second.size()> letters{};
    const auto middle = std::copy(First.begin(), First.end(), letters.begin());
    std::copy(Second.begin(), Second.end(), middle);
    return letters;
  }();
  static constexpr std::string_view kText{kLetters.data(), kLetters.size()};
};
inline constexpr std::string_view kSendGoal = "_SendGoal";
inline constexpr std::string_view kGetResult = "_GetResult";
inline constexpr std::string_view kFeedbackMessage = "_FeedbackMessage";

}  // namespace action_names

/// Service `ACTION/_action/send_goal`.
template <class A>
struct SendGoal {
  static constexpr std::string_view kType =
      action_names::Joined<A::kType, action_names::kSendGoal>::kText;
  struct Request {
    UUID goal_id;
    typename A::Goal goal;
    template <class Archive>
    void visit(Archive& archive) {
      archive(goal_id, goal);
    }
  };
  struct Response {
    bool accepted{};
    builtin_interfaces::Time stamp;
    template <class Archive>
    void visit(Archive& archive) {
      archive(accepted, stamp);
    }
  };
};

/// Service `ACTION/_action/get_result`.
template <class A>
struct GetResult {
  static constexpr std::string_view kType =
      action_names::Joined<A::kType, action_names::kGetResult>::kText;
  struct Request {
    UUID goal_id;
    template <class Archive>
    void visit(Archive& archive) {
      archive(goal_id);
    }
  };
  struct Response {
    std::int8_t status{};  ///< action_msgs::GoalStatus
    typename A::Result result;
    template <class Archive>
    void visit(Archive& archive) {
      archive(status, result);
    }
  };
};

/// Topic `ACTION/_action/feedback`.
template <class A>
struct FeedbackMessage {
  static constexpr std::string_view kType =
      action_names::Joined<A::kType, action_names::kFeedbackMessage>::kText;
  UUID goal_id;
  typename A::Feedback feedback;
  template <class Archive>
  void visit(Archive& archive) {
    archive(goal_id, feedback);
  }
};

}  // namespace canopeer::ros
