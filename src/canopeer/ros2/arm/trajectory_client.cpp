#include "canopeer/ros2/arm/trajectory_client.h"

#include <utility>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kGoalLook(10);  // between two looks at who may end a goal
constexpr milliseconds kAnswer(2000);  // to a goal
constexpr milliseconds kCancelAnswer(500);
constexpr int kCancelTries = 3;
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

TrajectoryClient::~TrajectoryClient() { stop(); }

void TrajectoryClient::stop() {
  if (under_way_ && cancel()) under_way_ = false;
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
  gives_feedback_ = gives_feedback();
  news_ = news;
  sent_ = Steady::now();
  auto accepted = client_->send(goal, std::move(events), kAnswer);
  under_way_ = !accepted || *accepted;  // who does not answer may have taken it
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
  if (news_->ended || !(news_->feedback || gives_feedback_)) return std::nullopt;
  const auto last = news_->feedback.value_or(sent_);
  const double silent_s = std::chrono::duration<double>(now - last).count();
  if (silent_s <= watch.max_feedback_silence_s) return std::nullopt;
  return "the controller gave no feedback for " + figure(silent_s, 1) + " s";
}

/// In this goal or one before.
bool TrajectoryClient::gives_feedback() const {
  if (gives_feedback_ || news_ == nullptr) return gives_feedback_;
  const std::lock_guard lock(news_->mutex);
  return news_->feedback.has_value();
}

/// The action's server went away in the middle of the goal.
bool TrajectoryClient::gone() const {
  if (client_->ready()) return false;
  const std::lock_guard lock(news_->mutex);
  return !news_->ended;
}

/// The error: no answer, though asked several times.
Expected<void> TrajectoryClient::cancel() {
  Expected<bool> answer = false;
  for (int i = 0; i < kCancelTries; ++i) {
    answer = client_->cancel(kCancelAnswer);
    if (answer) return {};  // who refuses has ended the goal already, or says so soon
  }
  return tl::unexpected(answer.error());
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
    if (gone()) {
      static_cast<void>(cancel());
      return fail("lost " + action_ + ": its server went away while it moved");
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
