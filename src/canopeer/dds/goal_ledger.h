#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "canopeer/cdr/messages/action_msgs.h"
#include "canopeer/dds/service.h"

namespace canopeer::ros {

using unique_identifier_msgs::UUID;

/// action_msgs/msg/GoalStatus.
enum class GoalState : std::int8_t {
  unknown,
  accepted,
  executing,
  canceling,
  succeeded,
  canceled,
  aborted
};
[[nodiscard]] bool has_ended(GoalState state);

/// An id drawn anew.
[[nodiscard]] UUID new_goal_id();
/// The system's clock, as ROS stamps goals where no simulated time is used.
[[nodiscard]] builtin_interfaces::Time system_stamp();

/// The goals of an action server: their states, who waits for results, and the results, kept for
/// fifteen minutes as ROS does. Thread-safe.
class GoalLedger {
 public:
  /// False: there is such a goal already.
  bool begin(const UUID& id, const builtin_interfaces::Time& stamp);
  /// A goal that has ended stays so.
  void set(const UUID& id, GoalState state);
  /// Ends a goal with its answer to get_result; those who wait for it. Nobody: it has ended before.
  [[nodiscard]] std::vector<RawReply> end(const UUID& id, GoalState state, Payload answer);
  /// The answer to get_result. Nothing: not ended yet, `reply` is kept for `end`.
  [[nodiscard]] std::optional<Payload> answer_or_wait(const UUID& id, RawReply reply,
                                                      const Payload& unknown);
  /// Goals that a request to cancel means and that have not ended.
  [[nodiscard]] std::vector<action_msgs::GoalInfo> meant_by(
      const action_msgs::GoalInfo& request) const;
  /// What to answer when none of them is cancelled: CancelGoal::Response's codes.
  [[nodiscard]] std::int8_t why_not(const action_msgs::GoalInfo& request) const;
  [[nodiscard]] action_msgs::GoalStatusArray statuses() const;

 private:
  struct Goal {
    action_msgs::GoalInfo info;
    GoalState state = GoalState::accepted;
    std::chrono::steady_clock::time_point ended;
    Payload answer;
    std::vector<RawReply> waiting;
  };
  [[nodiscard]] Goal* find(const UUID& id);
  [[nodiscard]] const Goal* find(const UUID& id) const;
  void drop_old();

  mutable std::mutex mutex_;
  std::deque<Goal> goals_;  ///< oldest first
};

}  // namespace canopeer::ros
