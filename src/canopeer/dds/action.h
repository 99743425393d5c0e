#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "canopeer/cdr/messages/action_types.h"
#include "canopeer/dds/service.h"

// Actions: three services and two topics under NAME/_action
// (design.ros2.org/articles/actions.html).

namespace canopeer::ros {

/// action_msgs/msg/GoalStatus.
enum class GoalState : std::int8_t {
  unknown, accepted, executing, canceling, succeeded, canceled, aborted
};

/// A client of action type `A` (A::Goal, A::Result, A::Feedback), one goal at a time: a new one
/// forgets the one before. Thread-safe; callbacks come from threads of the DDS library.
template <class A>
class ActionClient {
 public:
  struct Events {
    std::function<void(const typename A::Feedback&)> on_feedback;
    std::function<void(GoalState)> on_status;
    std::function<void(GoalState, const typename A::Result&)> on_result;
  };
  [[nodiscard]] static Expected<std::unique_ptr<ActionClient>> make(Node& node,
                                                                    const std::string& action);
  /// All three services and both topics are there.
  [[nodiscard]] bool ready() const;
  /// Sends the goal and waits until it is accepted (true) or rejected (false); the result comes by
  /// events. The error: nobody is there, or no answer came in time.
  [[nodiscard]] Expected<bool> send(const typename A::Goal& goal, Events events,
                                    std::chrono::milliseconds patience);
  /// Asks the server to cancel the goal sent last; true: it will.
  [[nodiscard]] Expected<bool> cancel(std::chrono::milliseconds patience);
};

/// A server of action type `A`. One goal is active at a time.
template <class A>
class ActionServer {
 public:
  struct Handlers {
    std::function<bool(const UUID&, const typename A::Goal&)> accept;  ///< false: rejected
    std::function<void(const UUID&, const typename A::Goal&)> start;   ///< begin; returns at once
    std::function<bool(const UUID&)> cancel;                           ///< false: refused
  };
  [[nodiscard]] static Expected<std::unique_ptr<ActionServer>> make(Node& node,
                                                                    const std::string& action,
                                                                    Handlers handlers);
  void feedback(const UUID& goal, const typename A::Feedback& feedback);
  /// Ends a goal: succeeded, canceled or aborted.
  void finish(const UUID& goal, GoalState state, const typename A::Result& result);
};

}  // namespace canopeer::ros
