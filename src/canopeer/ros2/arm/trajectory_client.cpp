#include "canopeer/ros2/arm/trajectory_client.h"

#include <utility>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kGoalLook(10);  // between two looks at who may end a goal
constexpr milliseconds kAnswer(2000);  // to a goal
constexpr milliseconds kCancelAnswer(500);
constexpr milliseconds kBraking(5000);         // after a goal was cancelled, until its result
constexpr milliseconds kResultAfterEnd(1000);  // its reply may be lost

bool final_state(GoalState state) {
  return state == GoalState::succeeded || state == GoalState::canceled ||
         state == GoalState::aborted;
}

}  // namespace

Expected<std::unique_ptr<TrajectoryClient>> TrajectoryClient::make(Node& node,
                                                                   const std::string& action) {
  auto client = ActionClient<FollowJointTrajectory>::make(node, action);
  if (!client) return fail_in(action, client.error());
  return std::unique_ptr<TrajectoryClient>(new TrajectoryClient(action, std::move(*client)));
}

TrajectoryClient::~TrajectoryClient() {
  if (under_way_) static_cast<void>(cancel());
}

Expected<bool> TrajectoryClient::send(const FollowJointTrajectory::Goal& goal) {
  const auto news = std::make_shared<News>();
  ActionClient<FollowJointTrajectory>::Events events;
  events.on_feedback = [news](const FollowJointTrajectory::Feedback&) {
    const std::lock_guard lock(news->mutex);
    news->feedback = Steady::now();
  };
  events.on_status = [news](GoalState state) {
    const std::lock_guard lock(news->mutex);
    news->status = state;
    if (final_state(state) && !news->ended) news->ended = Steady::now();
    news->changed.notify_all();
  };
  events.on_result = [news](GoalState state, const FollowJointTrajectory::Result& result) {
    const std::lock_guard lock(news->mutex);
    news->result = GoalEnding{state, result, std::nullopt};
    news->changed.notify_all();
  };
  news_ = news;
  sent_ = Steady::now();
  auto accepted = client_->send(goal, std::move(events), kAnswer);
  under_way_ = accepted.value_or(false);
  return accepted;
}

/// The end of the goal, if it comes in a moment. One whose result is lost ends without.
std::optional<GoalEnding> TrajectoryClient::wait_a_little() const {
  std::unique_lock lock(news_->mutex);
  news_->changed.wait_for(lock, kGoalLook, [this] { return news_->result.has_value(); });
  if (news_->result) return news_->result;
  if (!news_->ended || Steady::now() - *news_->ended < kResultAfterEnd) return std::nullopt;
  return GoalEnding{news_->status, {0, "its result did not come"}, std::nullopt};
}

/// Why the goal is to be cancelled; nothing: it is not.
std::optional<std::string> TrajectoryClient::reason(const GoalWatch& watch) const {
  if (watch.cancel) {
    if (auto why = watch.cancel()) return why;
  }
  const auto now = Steady::now();
  const double taken_s = std::chrono::duration<double>(now - sent_).count();
  if (taken_s > watch.longest_s) {
    return "it was under way for " + figure(taken_s, 1) + " s, which is too long";
  }
  const std::lock_guard lock(news_->mutex);
  if (!news_->feedback || news_->ended) return std::nullopt;
  const double silent_s = std::chrono::duration<double>(now - *news_->feedback).count();
  if (silent_s <= watch.max_feedback_silence_s) return std::nullopt;
  return "the controller gave no feedback for " + figure(silent_s, 1) + " s";
}

Expected<void> TrajectoryClient::cancel() {
  const auto answer = client_->cancel(kCancelAnswer);
  if (!answer) return tl::unexpected(answer.error());
  return {};  // who refuses has ended the goal already, or says so soon
}

Expected<GoalEnding> TrajectoryClient::finish(const GoalWatch& watch) {
  std::optional<std::string> cancelled;
  Steady::time_point patience;
  while (true) {
    if (auto ending = wait_a_little()) {
      under_way_ = false;
      ending->cancelled = std::move(cancelled);
      return *ending;
    }
    if (const auto alive = watch.alive ? watch.alive() : Expected<void>(); !alive) {
      static_cast<void>(cancel());  // it may stop at least
      return fail(alive.error().message + "; " + action_ + " was told to stop");
    }
    if (cancelled && Steady::now() > patience) {
      return fail("lost " + action_ + ": told to stop (" + *cancelled +
                  "), it did not say what became of the motion");
    }
    if (cancelled) continue;
    cancelled = reason(watch);
    if (!cancelled) continue;
    if (auto ok = cancel(); !ok) {
      return fail("lost " + action_ + ": " + *cancelled + ", and it does not answer (" +
                  ok.error().message + ")");
    }
    patience = Steady::now() + kBraking;
  }
}

}  // namespace canopeer::ros
