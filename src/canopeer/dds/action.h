#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "canopeer/cdr/messages/action_types.h"
#include "canopeer/dds/goal_ledger.h"
#include "canopeer/dds/service.h"

// Actions: three services and two topics under NAME/_action
// (design.ros2.org/articles/actions.html).

namespace canopeer::ros {

/// A client of action type `A` (A::Goal, A::Result, A::Feedback), one goal at a time: a new one
/// forgets the one before. Thread-safe; callbacks come from threads of the DDS library and must not
/// wait for an answer themselves.
template <class A>
class ActionClient {
 public:
  /// Whom a goal tells of what becomes of it; each may be empty.
  struct Events {
    std::function<void(const typename A::Feedback&)> on_feedback;
    std::function<void(GoalState)> on_status;  ///< when it changed
    /// Once. `GoalState::unknown`: the server does not know the goal, it was started anew perhaps.
    std::function<void(GoalState, const typename A::Result&)> on_result;
  };
  [[nodiscard]] static Expected<std::unique_ptr<ActionClient>> make(Node& node,
                                                                    const std::string& action);
  /// All three services and both topics are there.
  [[nodiscard]] bool ready() const;
  /// Sends the goal and waits until it is accepted (true) or rejected (false); the result comes by
  /// events. The error: not all of the server is there, no answer came in time, or the result
  /// cannot be asked for; then the goal is cancelled, now and when it is accepted late.
  [[nodiscard]] Expected<bool> send(const typename A::Goal& goal, Events events,
                                    std::chrono::milliseconds patience);
  /// Asks the server to cancel the goal sent last; true: it will.
  [[nodiscard]] Expected<bool> cancel(std::chrono::milliseconds patience);

 private:
  /// The goal sent last.
  struct Current {
    UUID id;
    Events events;
    std::atomic<GoalState> state{GoalState::unknown};
  };
  class Latest {
   public:
    void set(std::shared_ptr<Current> current) {
      const std::lock_guard lock(mutex_);
      current_ = std::move(current);
    }
    /// Null: another goal's id.
    [[nodiscard]] std::shared_ptr<Current> with(const UUID& id) const {
      const auto current = any();
      return current != nullptr && current->id.uuid == id.uuid ? current : nullptr;
    }
    [[nodiscard]] std::shared_ptr<Current> any() const {
      const std::lock_guard lock(mutex_);
      return current_;
    }

   private:
    mutable std::mutex mutex_;
    std::shared_ptr<Current> current_;
  };
  using Send = Client<SendGoal<A>>;
  using Result = Client<GetResult<A>>;
  using Cancel = Client<action_msgs::CancelGoal>;

  ActionClient(Send send, Result result, Cancel cancel)
      : cancel_(std::move(cancel)), send_(std::move(send)), result_(std::move(result)) {}
  [[nodiscard]] Expected<void> listen(Node& node, const std::string& action);
  [[nodiscard]] Expected<void> ask_result(const std::shared_ptr<Current>& current);
  void cancel_unheard(const UUID& goal);

  const std::shared_ptr<Latest> latest_ = std::make_shared<Latest>();
  Cancel cancel_;  // before what late answers come from
  Send send_;
  Result result_;
  Subscription feedback_;
  Subscription status_;
};

/// A server of action type `A`. Goals may overlap: `accept` and `start` decide what becomes of the
/// one before. Handlers run in the node's thread, one at a time.
template <class A>
class ActionServer {
 public:
  /// What a server does with goals.
  struct Handlers {
    std::function<bool(const UUID&, const typename A::Goal&)> accept;  ///< false: rejected
    std::function<void(const UUID&, const typename A::Goal&)> start;   ///< begin; returns at once
    std::function<bool(const UUID&)> cancel;                           ///< false: refused
    /// True: requests are not heard, as of a server that hangs. Empty: they are.
    std::function<bool()> deaf{};
  };
  [[nodiscard]] static Expected<std::unique_ptr<ActionServer>> make(Node& node,
                                                                    const std::string& action,
                                                                    Handlers handlers);
  void feedback(const UUID& goal, const typename A::Feedback& feedback);
  /// Ends a goal: succeeded, canceled or aborted. The result is kept for fifteen minutes.
  void finish(const UUID& goal, GoalState state, const typename A::Result& result);

 private:
  using Cancel = action_msgs::CancelGoal;
  explicit ActionServer(Handlers handlers) : handlers_(std::move(handlers)) {}
  [[nodiscard]] Expected<void> open(Node& node, const std::string& action);
  [[nodiscard]] bool deaf() const { return handlers_.deaf && handlers_.deaf(); }
  void take_goal(typename SendGoal<A>::Request&& request,
                 const typename Server<SendGoal<A>>::Reply& reply);
  void take_cancel(const action_msgs::GoalInfo& request,
                   const typename Server<Cancel>::Reply& reply);

  const Handlers handlers_;
  GoalLedger ledger_;
  Publisher<FeedbackMessage<A>> feedback_;
  Publisher<action_msgs::GoalStatusArray> status_;
  // Go first: their handlers use the above.
  std::unique_ptr<RawServer> results_;
  std::unique_ptr<Server<Cancel>> cancels_;
  std::unique_ptr<Server<SendGoal<A>>> goals_;
};

}  // namespace canopeer::ros

#include "canopeer/dds/action_body.h"
