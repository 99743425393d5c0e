#include "canopeer/dds/action.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "canopeer/cdr/messages/control_msgs.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using namespace std::chrono_literals;
using Follow = control_msgs::FollowJointTrajectory;
using testing_support::eventually;
using testing_support::make_node;

constexpr const char* kAction = "/arm/follow_joint_trajectory";

Follow::Goal goal_for(const std::string& joint) {
  Follow::Goal goal;
  goal.trajectory.joint_names = {joint};
  goal.trajectory.points.resize(1);
  goal.trajectory.points[0].positions = {0.5};
  return goal;
}

/// A controller that does what the test says. It takes goals for joint "elbow" only.
class Controller {
 public:
  explicit Controller(Node& node) {
    ActionServer<Follow>::Handlers handlers;
    handlers.accept = [](const UUID&, const Follow::Goal& goal) {
      return goal.trajectory.joint_names == std::vector<std::string>{"elbow"};
    };
    handlers.start = [this](const UUID& id, const Follow::Goal&) {
      const std::lock_guard lock(mutex_);
      started_.push_back(id);
    };
    handlers.cancel = [this](const UUID&) { return cancellable_.load(); };
    server_ = must(ActionServer<Follow>::make(node, kAction, std::move(handlers)));
  }
  [[nodiscard]] std::size_t started() const {
    const std::lock_guard lock(mutex_);
    return started_.size();
  }
  /// The goal started as the `n`th; it comes a moment after it was accepted.
  [[nodiscard]] UUID goal(std::size_t n = 1) const {
    if (!eventually([&] { return started() >= n; })) return {};
    const std::lock_guard lock(mutex_);
    return started_[n - 1];
  }
  void refuse_to_cancel() { cancellable_ = false; }
  ActionServer<Follow>& server() { return *server_; }

 private:
  mutable std::mutex mutex_;
  std::vector<UUID> started_;
  std::atomic<bool> cancellable_{true};
  std::unique_ptr<ActionServer<Follow>> server_;
};

/// What a client is told.
class Heard {
 public:
  ActionClient<Follow>::Events events() {
    return {[this](const Follow::Feedback& feedback) {
              const std::lock_guard lock(mutex_);
              feedback_.push_back(feedback.joint_names.at(0));
            },
            [this](GoalState state) {
              const std::lock_guard lock(mutex_);
              states_.push_back(state);
            },
            [this](GoalState state, const Follow::Result& result) {
              const std::lock_guard lock(mutex_);
              ended_ = state;
              text_ = result.error_string;
            }};
  }
  [[nodiscard]] std::vector<std::string> feedback() const {
    const std::lock_guard lock(mutex_);
    return feedback_;
  }
  [[nodiscard]] bool was(GoalState state) const {
    const std::lock_guard lock(mutex_);
    return std::find(states_.begin(), states_.end(), state) != states_.end();
  }
  [[nodiscard]] std::optional<GoalState> ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
  }
  [[nodiscard]] std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> feedback_;
  std::vector<GoalState> states_;
  std::optional<GoalState> ended_;
  std::string text_;
};

class Action : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(eventually([&] { return client_->ready(); }));
  }
  std::unique_ptr<Node> here_ = make_node("here");
  std::unique_ptr<Node> there_ = make_node("there");
  Controller controller_{*there_};
  Heard heard_;
  std::unique_ptr<ActionClient<Follow>> client_ = must(ActionClient<Follow>::make(*here_, kAction));
};

TEST_F(Action, AGoalIsAcceptedFollowedAndEnds) {
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), heard_.events(), 10s)));
  ASSERT_TRUE(eventually([&] { return heard_.was(GoalState::executing); }));
  Follow::Feedback feedback;
  feedback.joint_names = {"elbow"};
  controller_.server().feedback(controller_.goal(), feedback);
  controller_.server().feedback(new_goal_id(), feedback);  // somebody else's
  ASSERT_TRUE(eventually([&] { return !heard_.feedback().empty(); }));
  controller_.server().finish(controller_.goal(), GoalState::succeeded, {0, "there"});
  ASSERT_TRUE(eventually([&] { return heard_.ended() && heard_.was(GoalState::succeeded); }));
  EXPECT_EQ(*heard_.ended(), GoalState::succeeded);
  EXPECT_EQ(heard_.text(), "there");
  EXPECT_EQ(heard_.feedback().size(), 1U);
}

/// The services of an action, whose answer to a goal comes when the test says.
TEST(SlowAction, AGoalAcceptedTooLateIsCancelledThen) {
  const auto here = make_node("here");
  const auto there = make_node("there");
  const std::string base = std::string(kAction) + "/_action/";
  std::mutex mutex;
  std::optional<Server<SendGoal<Follow>>::Reply> reply;
  std::atomic<int> cancels = 0;
  const auto goals = must(Server<SendGoal<Follow>>::make(
      *there, base + "send_goal", [&](SendGoal<Follow>::Request&&, auto answer) {
        const std::lock_guard lock(mutex);
        reply = answer;
      }));
  const auto results =
      must(Server<GetResult<Follow>>::make(*there, base + "get_result", [](auto&&, auto) {}));
  const auto stops = must(
      Server<action_msgs::CancelGoal>::make(*there, base + "cancel_goal", [&](auto&&, auto answer) {
        ++cancels;
        answer({});
      }));
  const auto feedback = must(there->advertise<FeedbackMessage<Follow>>(base + "feedback"));
  const auto status =
      must(there->advertise<action_msgs::GoalStatusArray>(base + "status", kLatchedQos));
  const auto client = must(ActionClient<Follow>::make(*here, kAction));
  const auto nobodys = must(ActionClient<Follow>::make(*here, "/nobody/follow"));
  ASSERT_FALSE(nobodys->send(goal_for("elbow"), {}, 10s)) << "its server is not there";
  ASSERT_TRUE(eventually([&] { return client->ready(); }));
  const auto sent = client->send(goal_for("elbow"), {}, 100ms);
  ASSERT_FALSE(sent);
  EXPECT_NE(sent.error().message.find("no answer to a goal within 100 ms"), std::string::npos);
  ASSERT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return cancels == 1 && reply.has_value();
  })) << cancels
      << " cancels; the goal " << (reply ? "came" : "did not come");
  (*reply)({true, {}});
  EXPECT_TRUE(eventually([&] { return cancels == 2; }));
}

TEST_F(Action, AGoalMayBeRejected) {
  EXPECT_FALSE(must(client_->send(goal_for("tail"), heard_.events(), 10s)));
  EXPECT_EQ(controller_.started(), 0U);
}

TEST_F(Action, AGoalIsCancelledByItsSender) {
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), heard_.events(), 10s)));
  EXPECT_TRUE(must(client_->cancel(10s)));
  ASSERT_TRUE(eventually([&] { return heard_.was(GoalState::canceling); }));
  controller_.server().finish(controller_.goal(), GoalState::canceled, {});
  ASSERT_TRUE(eventually([&] { return heard_.ended().has_value(); }));
  EXPECT_EQ(*heard_.ended(), GoalState::canceled);
  EXPECT_FALSE(must(client_->cancel(10s))) << "it has ended";
}

TEST_F(Action, ACancelMayBeRefused) {
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), heard_.events(), 10s)));
  controller_.refuse_to_cancel();
  EXPECT_FALSE(must(client_->cancel(10s)));
}

TEST_F(Action, OthersMayCancelAllGoals) {
  using action_msgs::CancelGoal;
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), heard_.events(), 10s)));
  auto other =
      must(Client<CancelGoal>::make(*here_, std::string(kAction) + "/_action/cancel_goal"));
  ASSERT_TRUE(eventually([&] { return other.ready(); }));
  const auto unknown = must(other.call({{new_goal_id(), {}}}, 10s));
  EXPECT_EQ(unknown.return_code, CancelGoal::Response::ERROR_UNKNOWN_GOAL_ID);
  const auto all = must(other.call({}, 10s));
  EXPECT_EQ(all.return_code, CancelGoal::Response::ERROR_NONE);
  ASSERT_EQ(all.goals_canceling.size(), 1U);
  EXPECT_EQ(all.goals_canceling[0].goal_id, controller_.goal());
}

TEST_F(Action, AResultCanBeAskedForAfterTheEnd) {
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), {}, 10s)));
  controller_.server().finish(controller_.goal(), GoalState::aborted, {-4, "path"});
  auto results =
      must(Client<GetResult<Follow>>::make(*here_, std::string(kAction) + "/_action/get_result"));
  ASSERT_TRUE(eventually([&] { return results.ready(); }));
  for (int i = 0; i < 2; ++i) {
    const auto late = must(results.call({controller_.goal()}, 10s));
    EXPECT_EQ(late.status, action_msgs::GoalStatus::STATUS_ABORTED);
    EXPECT_EQ(late.result.error_string, "path");
  }
  const auto unknown = must(results.call({new_goal_id()}, 10s));
  EXPECT_EQ(unknown.status, action_msgs::GoalStatus::STATUS_UNKNOWN);
}

TEST_F(Action, ANewGoalForgetsTheOneBefore) {
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), heard_.events(), 10s)));
  const UUID first = controller_.goal();
  Heard second;
  ASSERT_TRUE(must(client_->send(goal_for("elbow"), second.events(), 10s)));
  controller_.server().finish(first, GoalState::aborted, {});
  controller_.server().finish(controller_.goal(2), GoalState::succeeded, {});
  ASSERT_TRUE(eventually([&] { return second.ended().has_value(); }));
  EXPECT_EQ(*second.ended(), GoalState::succeeded);
  EXPECT_FALSE(heard_.ended().has_value());
}

}  // namespace
}  // namespace canopeer::ros
