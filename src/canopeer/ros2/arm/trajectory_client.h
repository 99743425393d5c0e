#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "canopeer/dds/action.h"
#include "canopeer/ros2/arm/trajectory_goal.h"

namespace canopeer::ros {

/// Who may end a goal before its controller does.
struct GoalWatch {
  /// Asked all the time. The error: whoever moves the joints is gone, or nobody knows where they
  /// are. The goal is cancelled, and the error handed on.
  std::function<Expected<void>()> alive;
  /// Asked all the time; a text: why the goal is to be cancelled.
  std::function<std::optional<std::string>()> cancel;
  double longest_s = 3600.0;            ///< then it is cancelled
  double max_feedback_silence_s = 1.0;  ///< of a controller that gives any; then it is cancelled
};

/// How a goal ended.
struct GoalEnding {
  GoalState state = GoalState::unknown;
  FollowJointTrajectory::Result result;
  std::optional<std::string> cancelled;  ///< why we cancelled it; none: we did not
};

/// Sends trajectories to a controller, one at a time, and waits for what becomes of them. Used by
/// one thread.
class TrajectoryClient {
 public:
  /// `node` outlives the client.
  [[nodiscard]] static Expected<std::unique_ptr<TrajectoryClient>> make(Node& node,
                                                                        const std::string& action);
  /// Cancels a goal that is under way.
  ~TrajectoryClient();
  /// Cancels a goal that is under way, as far as is known, without waiting for its end.
  void stop();
  [[nodiscard]] bool ready() const { return client_->ready(); }
  [[nodiscard]] const std::string& action() const { return action_; }

  /// False: the controller refuses it. The error: nobody is there, or none answers.
  [[nodiscard]] Expected<bool> send(const FollowJointTrajectory::Goal& goal);
  /// Waits for the result of the goal sent last. The error: the controller is lost.
  [[nodiscard]] Expected<GoalEnding> finish(const GoalWatch& watch);

 private:
  using Steady = std::chrono::steady_clock;
  /// What the action's callbacks say; it outlives them.
  struct News {
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Steady::time_point> feedback;  ///< last heard
    std::optional<Steady::time_point> ended;     ///< the status says so
    GoalState status = GoalState::unknown;
    std::optional<GoalEnding> result;
  };
  TrajectoryClient(std::string action, std::unique_ptr<ActionClient<FollowJointTrajectory>> client)
      : action_(std::move(action)), client_(std::move(client)) {}
  [[nodiscard]] std::optional<GoalEnding> wait_a_little() const;
  [[nodiscard]] std::optional<std::string> reason(const GoalWatch& watch) const;
  [[nodiscard]] bool gives_feedback() const;
  [[nodiscard]] bool gone() const;
  [[nodiscard]] Expected<void> cancel();

  std::string action_;
  std::unique_ptr<ActionClient<FollowJointTrajectory>> client_;
  std::shared_ptr<News> news_;   ///< of the goal sent last
  bool under_way_ = false;       ///< it is, as far as we know
  bool gives_feedback_ = false;  ///< this controller, as was seen in earlier goals
  Steady::time_point sent_;
};

}  // namespace canopeer::ros
