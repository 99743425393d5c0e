#include <gtest/gtest.h>

#include <mutex>
#include <optional>
#include <thread>

#include "canopeer/cdr/messages/control_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/action.h"
#include "child.h"
#include "ros_fixture.h"
#include "support/must.h"

// Peers on Cyclone DDS, who speak as ROS 2 does with rmw_cyclonedds.

namespace canopeer::ros {
namespace {

using namespace std::chrono_literals;
using canopeer::testing_support::Child;
using canopeer::testing_support::own_domain;
using Follow = control_msgs::FollowJointTrajectory;
using std_srvs::SetBool;
using testing_support::eventually;
using testing_support::make_node;

class CycloneRobot : public testing::Test {
 protected:
  Child robot_{{CANOPEER_CYCLONE_ROBOT, std::to_string(own_domain())}};
  std::unique_ptr<Node> node_ = make_node("here");
};

TEST_F(CycloneRobot, IsKnownByItsMaker) {
  ASSERT_TRUE(eventually([&] { return node_->publishers_of("/from_cyclone").size() == 1; }));
  const auto peers = node_->participant().peers();
  ASSERT_EQ(peers.size(), 1U);
  EXPECT_EQ(peers[0].vendor_name(), "Eclipse Cyclone DDS");
  const auto endpoint = node_->publishers_of("/from_cyclone").at(0);
  EXPECT_EQ(node_->rmw_of(endpoint.guid), Rmw::cyclonedds);
  EXPECT_EQ(endpoint.type, "std_msgs::msg::dds_::String_");
}

TEST_F(CycloneRobot, HearsAndIsHeardOnTopics) {
  std::mutex mutex;
  std::vector<std::string> heard;
  std::optional<std::string> description;
  const auto publisher = must(node_->advertise<std_msgs::String>("/to_cyclone"));
  const Subscription echo = must(node_->subscribe<std_msgs::String>(
      "/from_cyclone", kDefaultQos, [&](std_msgs::String&& text, const Guid&) {
        const std::lock_guard lock(mutex);
        heard.push_back(std::move(text.data));
      }));
  const Subscription latched = must(node_->subscribe<std_msgs::String>(
      "/cyclone_description", kLatchedQos, [&](std_msgs::String&& text, const Guid&) {
        const std::lock_guard lock(mutex);
        description = std::move(text.data);
      }));
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && !echo->matched().empty(); }));
  const std::string long_text(1'000'000, 'x');
  // What is said before it has discovered us is lost on it.
  ASSERT_TRUE(eventually([&] {
    publisher.publish({long_text});
    const std::lock_guard lock(mutex);
    return !heard.empty() && heard.back() == long_text;
  }));
  ASSERT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return description.has_value();
  }));
  EXPECT_EQ(*description, "a robot");
}

TEST_F(CycloneRobot, AnswersTheFirstRequestAndAllAfterIt) {
  auto client = must(Client<SetBool>::make(*node_, "/cyclone/turn"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  for (int i = 0; i < 50; ++i) {
    const auto response = client.call({i % 2 == 0}, 10s);
    ASSERT_TRUE(response.has_value()) << i << ": " << response.error().message;
    EXPECT_EQ(response->success, i % 2 != 0);
    EXPECT_EQ(response->message, "turned");
  }
}

TEST_F(CycloneRobot, FollowsALongTrajectoryAndCancelsOne) {
  const auto client =
      must(ActionClient<Follow>::make(*node_, "/cyclone_arm/follow_joint_trajectory"));
  ASSERT_TRUE(eventually([&] { return client->ready(); }));
  std::mutex mutex;
  int feedback = 0;
  std::optional<GoalState> ended;
  std::string text;
  const ActionClient<Follow>::Events events{[&](const Follow::Feedback& message) {
                                              const std::lock_guard lock(mutex);
                                              if (message.joint_names.at(0) == "elbow") ++feedback;
                                            },
                                            {},
                                            [&](GoalState state, const Follow::Result& result) {
                                              const std::lock_guard lock(mutex);
                                              ended = state;
                                              text = result.error_string;
                                            }};
  const auto has_ended = [&] {
    const std::lock_guard lock(mutex);
    return ended.has_value();
  };
  Follow::Goal goal;
  goal.trajectory.joint_names = {"elbow"};
  goal.trajectory.points.resize(3000);  // many fragments
  for (auto& point : goal.trajectory.points) point.positions = {0.5};
  ASSERT_TRUE(must(client->send(goal, events, 10s)));
  ASSERT_TRUE(eventually(has_ended));
  EXPECT_EQ(*ended, GoalState::succeeded);
  EXPECT_EQ(text, "cyclone got there");
  EXPECT_EQ(feedback, 1);

  ended.reset();
  goal.trajectory.points.back().time_from_start.sec = 1000;
  ASSERT_TRUE(must(client->send(goal, events, 10s)));
  EXPECT_TRUE(must(client->cancel(10s)));
  ASSERT_TRUE(eventually(has_ended));
  EXPECT_EQ(*ended, GoalState::canceled);
  EXPECT_FALSE(must(client->send({}, events, 10s))) << "no joints";
}

TEST_F(CycloneRobot, ThatWasKilledAndStartedAgainAnswers) {
  auto client = must(Client<SetBool>::make(*node_, "/cyclone/turn"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  robot_.kill();
  const Child next({CANOPEER_CYCLONE_ROBOT, std::to_string(own_domain())});
  ASSERT_TRUE(eventually([&] {
    const auto response = client.call({true}, 200ms);
    return response.has_value() && !response->success;
  }));
}

TEST(CycloneUser, UsesOurServicesAndActions) {
  const auto node = make_node("here");
  const auto server =
      must(Server<SetBool>::make(*node, "/turn", [](SetBool::Request&& request, auto reply) {
        reply({!request.data, ""});
      }));
  std::unique_ptr<ActionServer<Follow>> arm;
  std::mutex mutex;
  std::vector<std::jthread> motions;
  ActionServer<Follow>::Handlers handlers;
  handlers.accept = [](const UUID&, const Follow::Goal& goal) {
    return !goal.trajectory.points.empty();
  };
  handlers.start = [&](const UUID& id, const Follow::Goal& goal) {
    if (goal.trajectory.points.size() == 1) return;  // goes on until it is cancelled
    Follow::Feedback feedback;
    feedback.joint_names = goal.trajectory.joint_names;
    arm->feedback(id, feedback);
    const std::lock_guard lock(mutex);
    motions.emplace_back([&arm, id] { arm->finish(id, GoalState::succeeded, {0, "there"}); });
  };
  handlers.cancel = [&](const UUID& id) {
    const std::lock_guard lock(mutex);
    motions.emplace_back([&arm, id] { arm->finish(id, GoalState::canceled, {0, "stopped"}); });
    return true;
  };
  arm =
      must(ActionServer<Follow>::make(*node, "/arm/follow_joint_trajectory", std::move(handlers)));

  Child user({CANOPEER_CYCLONE_USER, std::to_string(own_domain())});
  EXPECT_EQ(user.read_all(),
            "turned 20\n"
            "goal of 0 points rejected\n"
            "goal of 20000 points accepted\n"
            "result 4 there\n"
            "feedback heard\n"
            "goal of 1 points accepted\n"
            "cancelling 1\n"
            "result 5 stopped\n");
  user.stop();
  EXPECT_EQ(node->malformed(), 0);
}

}  // namespace
}  // namespace canopeer::ros
