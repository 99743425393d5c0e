#include "canopeer/dds/goal_ledger.h"

#include <algorithm>
#include <random>
#include <tuple>
#include <utility>

namespace canopeer::ros {
namespace {

using action_msgs::CancelGoal;
using action_msgs::GoalInfo;

constexpr std::chrono::minutes kResultsKept{15};
constexpr std::size_t kMostGoals = 100;

bool is_zero(const UUID& id) { return id.uuid == UUID{}.uuid; }
bool is_zero(const builtin_interfaces::Time& time) { return time.sec == 0 && time.nanosec == 0; }

bool not_after(const builtin_interfaces::Time& a, const builtin_interfaces::Time& b) {
  return std::tie(a.sec, a.nanosec) <= std::tie(b.sec, b.nanosec);
}

/// As ROS reads it: all goals, those up to a time, one goal, or both of the latter.
bool means(const GoalInfo& request, const GoalInfo& goal) {
  const bool timed = !is_zero(request.stamp);
  if (is_zero(request.goal_id) && !timed) return true;
  return goal.goal_id.uuid == request.goal_id.uuid ||
         (timed && not_after(goal.stamp, request.stamp));
}

}  // namespace

bool has_ended(GoalState state) { return state >= GoalState::succeeded; }

UUID new_goal_id() {
  std::random_device random;
  UUID id;
  for (auto& octet : id.uuid) octet = static_cast<std::uint8_t>(random());
  return id;
}

builtin_interfaces::Time system_stamp() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(now - seconds);
  return {static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>(rest.count())};
}

bool GoalLedger::begin(const UUID& id, const builtin_interfaces::Time& stamp) {
  const std::lock_guard lock(mutex_);
  drop_old();
  if (find(id) != nullptr) return false;
  goals_.emplace_back().info = {id, stamp};
  return true;
}

void GoalLedger::set(const UUID& id, GoalState state) {
  const std::lock_guard lock(mutex_);
  Goal* goal = find(id);
  if (goal != nullptr && !has_ended(goal->state)) goal->state = state;
}

std::vector<RawReply> GoalLedger::end(const UUID& id, GoalState state, Payload answer) {
  const std::lock_guard lock(mutex_);
  Goal* goal = find(id);
  if (goal == nullptr || has_ended(goal->state)) return {};
  goal->state = state;
  goal->ended = std::chrono::steady_clock::now();
  goal->answer = std::move(answer);
  return std::exchange(goal->waiting, {});
}

std::optional<Payload> GoalLedger::answer_or_wait(const UUID& id, RawReply reply,
                                                  const Payload& unknown) {
  const std::lock_guard lock(mutex_);
  Goal* goal = find(id);
  if (goal == nullptr) return unknown;
  if (has_ended(goal->state)) return goal->answer;
  goal->waiting.push_back(std::move(reply));
  return std::nullopt;
}

std::vector<GoalInfo> GoalLedger::meant_by(const GoalInfo& request) const {
  const std::lock_guard lock(mutex_);
  std::vector<GoalInfo> meant;
  for (const Goal& goal : goals_) {
    if (!has_ended(goal.state) && means(request, goal.info)) meant.push_back(goal.info);
  }
  return meant;
}

std::int8_t GoalLedger::why_not(const GoalInfo& request) const {
  const std::lock_guard lock(mutex_);
  if (is_zero(request.goal_id)) return CancelGoal::Response::ERROR_REJECTED;
  const Goal* goal = find(request.goal_id);
  if (goal == nullptr) return CancelGoal::Response::ERROR_UNKNOWN_GOAL_ID;
  return has_ended(goal->state) ? CancelGoal::Response::ERROR_GOAL_TERMINATED
                                : CancelGoal::Response::ERROR_REJECTED;
}

action_msgs::GoalStatusArray GoalLedger::statuses() const {
  const std::lock_guard lock(mutex_);
  action_msgs::GoalStatusArray all;
  for (const Goal& goal : goals_) {
    all.status_list.push_back({goal.info, static_cast<std::int8_t>(goal.state)});
  }
  return all;
}

GoalLedger::Goal* GoalLedger::find(const UUID& id) {
  return const_cast<Goal*>(std::as_const(*this).find(id));
}

const GoalLedger::Goal* GoalLedger::find(const UUID& id) const {
  const auto found = std::find_if(goals_.begin(), goals_.end(), [&](const Goal& goal) {
    return goal.info.goal_id.uuid == id.uuid;
  });
  return found == goals_.end() ? nullptr : &*found;
}

void GoalLedger::drop_old() {
  const auto now = std::chrono::steady_clock::now();
  while (!goals_.empty() && has_ended(goals_.front().state) &&
         (goals_.size() >= kMostGoals || now - goals_.front().ended > kResultsKept)) {
    goals_.pop_front();
  }
}

}  // namespace canopeer::ros
