#pragma once

#include <utility>

#include "canopeer/dds/action.h"

// Included by action.h: what its templates do.

namespace canopeer::ros {

template <class A>
Expected<std::unique_ptr<ActionClient<A>>> ActionClient<A>::make(Node& node,
                                                                 const std::string& action) {
  const std::string base = node.resolve(action) + "/_action/";
  auto send = Send::make(node, base + "send_goal");
  if (!send) return tl::unexpected(send.error());
  auto result = Result::make(node, base + "get_result");
  if (!result) return tl::unexpected(result.error());
  auto cancel = Cancel::make(node, base + "cancel_goal");
  if (!cancel) return tl::unexpected(cancel.error());
  std::unique_ptr<ActionClient> client(
      new ActionClient(std::move(*send), std::move(*result), std::move(*cancel)));
  const auto listening = client->listen(node, base);
  if (!listening) return tl::unexpected(listening.error());
  return client;
}

template <class A>
Expected<void> ActionClient<A>::listen(Node& node, const std::string& base) {
  auto feedback = node.subscribe<FeedbackMessage<A>>(
      base + "feedback", kDefaultQos,
      [latest = latest_](FeedbackMessage<A>&& message, const Guid&) {
        const auto current = latest->with(message.goal_id);
        if (current && current->events.on_feedback) current->events.on_feedback(message.feedback);
      });
  if (!feedback) return tl::unexpected(feedback.error());
  feedback_ = std::move(*feedback);
  auto status = node.subscribe<action_msgs::GoalStatusArray>(
      base + "status", kLatchedQos,
      [latest = latest_](action_msgs::GoalStatusArray&& message, const Guid&) {
        for (const action_msgs::GoalStatus& goal : message.status_list) {
          const auto current = latest->with(goal.goal_info.goal_id);
          const auto state = static_cast<GoalState>(goal.status);
          if (current && current->state.exchange(state) != state && current->events.on_status) {
            current->events.on_status(state);
          }
        }
      });
  if (!status) return tl::unexpected(status.error());
  status_ = std::move(*status);
  return {};
}

template <class A>
bool ActionClient<A>::ready() const {
  return send_.ready() && result_.ready() && cancel_.ready() && !feedback_->matched().empty() &&
         !status_->matched().empty();
}

template <class A>
Expected<bool> ActionClient<A>::send(const typename A::Goal& goal, Events events,
                                     std::chrono::milliseconds patience) {
  using Response = typename SendGoal<A>::Response;
  if (!ready()) return fail("the action's server is not there, or not all of it");
  const auto current = std::make_shared<Current>();
  current->id = new_goal_id();
  current->events = std::move(events);
  latest_->set(current);
  const auto answer = std::make_shared<Awaited<Response>>();
  const auto given_up = std::make_shared<std::atomic<bool>>(false);
  const auto sent = send_.ask({current->id, goal},
                              [this, answer, given_up, id = current->id](Response&& response) {
                                const bool accepted = response.accepted;
                                answer->give(std::move(response));
                                if (*given_up && accepted) cancel_unheard(id);
                              });
  if (!sent) return tl::unexpected(sent.error());
  const auto response = answer->wait(patience, [this] { return send_.ready(); });
  if (response && !(*response)->accepted) {
    latest_->set(nullptr);
    return false;
  }
  const auto asked =
      response
          ? ask_result(current)
          : Expected<void>(fail("no answer to a goal within " + std::to_string(patience.count()) +
                                " ms, or its server went away; the goal is cancelled"));
  if (asked) return true;
  *given_up = true;
  cancel_unheard(current->id);
  return tl::unexpected(asked.error());
}

/// Without waiting for what becomes of it.
template <class A>
void ActionClient<A>::cancel_unheard(const UUID& goal) {
  static_cast<void>(cancel_.ask({{goal, {}}}, [](auto&&) {}));
}

template <class A>
Expected<void> ActionClient<A>::ask_result(const std::shared_ptr<Current>& current) {
  auto asked = result_.ask(
      {current->id}, [latest = latest_, current](typename GetResult<A>::Response&& response) {
        if (latest->with(current->id) && current->events.on_result) {
          current->events.on_result(static_cast<GoalState>(response.status), response.result);
        }
      });
  if (!asked) return fail_in("the goal is accepted, its result cannot be asked for", asked.error());
  return {};
}

template <class A>
Expected<bool> ActionClient<A>::cancel(std::chrono::milliseconds patience) {
  const auto current = latest_->any();
  if (current == nullptr) return false;
  const auto response = cancel_.call({{current->id, {}}}, patience);
  if (!response) return tl::unexpected(response.error());
  for (const action_msgs::GoalInfo& goal : response->goals_canceling) {
    if (goal.goal_id.uuid == current->id.uuid) return true;
  }
  return false;
}

template <class A>
Expected<std::unique_ptr<ActionServer<A>>> ActionServer<A>::make(Node& node,
                                                                 const std::string& action,
                                                                 Handlers handlers) {
  std::unique_ptr<ActionServer> server(new ActionServer(std::move(handlers)));
  const auto opened = server->open(node, node.resolve(action) + "/_action/");
  if (!opened) return tl::unexpected(opened.error());
  return server;
}

template <class A>
Expected<void> ActionServer<A>::open(Node& node, const std::string& base) {
  auto feedback = node.advertise<FeedbackMessage<A>>(base + "feedback");
  if (!feedback) return tl::unexpected(feedback.error());
  feedback_ = std::move(*feedback);
  auto status = node.advertise<action_msgs::GoalStatusArray>(base + "status", kLatchedQos);
  if (!status) return tl::unexpected(status.error());
  status_ = std::move(*status);
  status_.publish({});

  using Results = GetResult<A>;
  auto results = make_raw_server(
      node, base + "get_result", dds_request_type<Results>(), dds_response_type<Results>(),
      [this, &node](Payload&& payload, RawReply reply) {
        const auto request = from_cdr<typename Results::Request>(payload);
        if (!request) return node.count_malformed();
        const auto answer =
            ledger_.answer_or_wait(request->goal_id, reply, to_cdr(typename Results::Response{}));
        if (answer) reply(*answer);
      });
  if (!results) return tl::unexpected(results.error());
  results_ = std::move(*results);
  auto cancels = Server<Cancel>::make(
      node, base + "cancel_goal",
      [this](Cancel::Request&& request, auto reply) { take_cancel(request.goal_info, reply); });
  if (!cancels) return tl::unexpected(cancels.error());
  cancels_ = std::make_unique<Server<Cancel>>(std::move(*cancels));
  auto goals = Server<SendGoal<A>>::make(
      node, base + "send_goal", [this](typename SendGoal<A>::Request&& request, auto reply) {
        take_goal(std::move(request), reply);
      });
  if (!goals) return tl::unexpected(goals.error());
  goals_ = std::make_unique<Server<SendGoal<A>>>(std::move(*goals));
  return {};
}

template <class A>
void ActionServer<A>::take_goal(typename SendGoal<A>::Request&& request,
                                const typename Server<SendGoal<A>>::Reply& reply) {
  if (deaf()) return;
  const auto stamp = system_stamp();
  if (!handlers_.accept(request.goal_id, request.goal) || !ledger_.begin(request.goal_id, stamp)) {
    return reply({false, stamp});
  }
  reply({true, stamp});
  status_.publish(ledger_.statuses());
  ledger_.set(request.goal_id, GoalState::executing);
  status_.publish(ledger_.statuses());
  handlers_.start(request.goal_id, request.goal);
}

template <class A>
void ActionServer<A>::take_cancel(const action_msgs::GoalInfo& request,
                                  const typename Server<Cancel>::Reply& reply) {
  if (deaf()) return;
  Cancel::Response response;
  for (const action_msgs::GoalInfo& goal : ledger_.meant_by(request)) {
    if (!handlers_.cancel(goal.goal_id)) continue;
    ledger_.set(goal.goal_id, GoalState::canceling);
    response.goals_canceling.push_back(goal);
  }
  if (response.goals_canceling.empty()) response.return_code = ledger_.why_not(request);
  reply(response);
  status_.publish(ledger_.statuses());
}

template <class A>
void ActionServer<A>::feedback(const UUID& goal, const typename A::Feedback& feedback) {
  feedback_.publish({goal, feedback});
}

template <class A>
void ActionServer<A>::finish(const UUID& goal, GoalState state, const typename A::Result& result) {
  const Payload answer =
      to_cdr(typename GetResult<A>::Response{static_cast<std::int8_t>(state), result});
  const auto waiting = ledger_.end(goal, state, answer);
  status_.publish(ledger_.statuses());
  for (const RawReply& reply : waiting) reply(answer);
}

}  // namespace canopeer::ros
