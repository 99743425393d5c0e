#include "canopeer/dds/node.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <mutex>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "child.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using canopeer::testing_support::Child;
using canopeer::testing_support::own_domain;
using testing_support::eventually;
using testing_support::make_node;
using testing_support::options_of;

/// Keeps the texts it hears.
class Listener {
 public:
  Listener(Node& node, const std::string& topic, const Qos& qos)
      : subscription_(must(node.subscribe<std_msgs::String>(
            topic, qos, [this](std_msgs::String&& message, const Guid&) {
              const std::lock_guard lock(mutex_);
              heard_.push_back(std::move(message.data));
            }))) {}
  [[nodiscard]] std::vector<std::string> heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  [[nodiscard]] bool heard_last(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    return !heard_.empty() && heard_.back() == text;
  }
  [[nodiscard]] std::size_t writers() const { return subscription_->matched().size(); }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> heard_;
  Subscription subscription_;
};

std::string error_of(const NodeOptions& options) {
  const auto node = Node::make(options);
  return node ? "" : node.error().message;
}

TEST(Node, HearsAllThatIsPublishedReliably) {
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto publisher = must(talker->advertise<std_msgs::String>("/chatter"));
  const Listener listener(*hearer, "chatter", kDefaultQos);
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && listener.writers() == 1; }));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(publisher.publish({std::to_string(i)}));
  ASSERT_TRUE(eventually([&] { return listener.heard().size() == 5; }));
  EXPECT_EQ(listener.heard(), (std::vector<std::string>{"0", "1", "2", "3", "4"}));
  EXPECT_EQ(hearer->malformed(), 0);
}

TEST(Node, GetsTheLastLatchedMessageWhenItComesLate) {
  const auto talker = make_node("talker");
  const auto publisher = must(talker->advertise<std_msgs::String>("/description", kLatchedQos));
  publisher.publish({"old"});
  publisher.publish({"new"});
  const auto late = make_node("late");
  const Listener latched(*late, "/description", kLatchedQos);
  const Listener fresh(*late, "/description", kDefaultQos);
  ASSERT_TRUE(eventually([&] { return latched.heard_last("new") && fresh.writers() == 1; }));
  publisher.publish({"newest"});
  ASSERT_TRUE(eventually([&] { return fresh.heard_last("newest"); }));
  EXPECT_EQ(latched.heard().front(), "new");
  EXPECT_EQ(fresh.heard().size(), 1U) << "who did not ask for it gets nothing old";
}

TEST(Node, ReaderWhoWantsMoreThanIsOfferedIsNotMatched) {
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto publisher = must(talker->advertise<std_msgs::String>("/images", kSensorQos));
  const Listener strict(*hearer, "/images", kDefaultQos);
  const Listener lax(*hearer, "/images", kSensorQos);
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && lax.writers() == 1; }));
  EXPECT_EQ(strict.writers(), 0U);
  ASSERT_TRUE(eventually([&] { return hearer->publishers_of("images").size() == 1; }));
  EXPECT_FALSE(hearer->publishers_of("images").at(0).qos.reliable);
  EXPECT_EQ(hearer->rmw_of(hearer->publishers_of("images").at(0).guid), Rmw::fastrtps);
}

TEST(Node, BigMessagesComeWhole) {
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto publisher = must(talker->advertise<std_msgs::String>("/big"));
  const Listener listener(*hearer, "/big", kDefaultQos);
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && listener.writers() == 1; }));
  for (const std::size_t size : {1'000'000, 20'000'000}) {
    std::string text(size, 'a');
    for (std::size_t i = 0; i < size; i += 997) text[i] = static_cast<char>('a' + i % 26);
    ASSERT_TRUE(publisher.publish({text}));
    ASSERT_TRUE(eventually([&] { return listener.heard_last(text); })) << size;
  }
}

TEST(Node, CountsMessagesThatAreNone) {
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto writer =
      must(talker->participant().writer("rt/chatter", "std_msgs::msg::dds_::String_", kDefaultQos));
  const Listener listener(*hearer, "/chatter", kDefaultQos);
  ASSERT_TRUE(eventually([&] { return writer->matched().size() == 1 && listener.writers() == 1; }));
  const std::vector<Payload> wrong = {
      {0, 1, 0, 0},                           // nothing in it
      {0, 1, 0, 0, 255, 255, 255, 255, 'a'},  // a text of 4 GB
      {0, 9, 0, 0, 2, 0, 0, 0, 'a', 0},       // another encoding
  };
  for (const Payload& payload : wrong) must(writer->write(payload));
  must(writer->write(to_cdr(std_msgs::String{"right"})));
  ASSERT_TRUE(eventually([&] { return listener.heard_last("right"); }));
  EXPECT_EQ(listener.heard().size(), 1U);
  EXPECT_EQ(hearer->malformed(), 3);
}

TEST(Node, DropsWhatIsTooLongForItsType) {
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto publisher = must(talker->advertise<sensor_msgs::JointState>("/joints"));
  std::atomic<int> heard{0};
  const auto subscription = must(hearer->subscribe<sensor_msgs::JointState>(
      "/joints", {}, [&](sensor_msgs::JointState&&, const Guid&) { ++heard; }));
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1; }));
  sensor_msgs::JointState state;
  state.name = {std::string(sensor_msgs::JointState::kMostOctets, 'x')};
  publisher.publish(state);
  state.name = {"elbow"};
  publisher.publish(state);
  ASSERT_TRUE(eventually([&] { return heard == 1; }));
  EXPECT_EQ(hearer->malformed(), 1);
}

TEST(Node, DropsWhatIsTooLongAndHearsTheNext) {
  const auto talker = make_node("talker");
  NodeOptions careful = options_of("careful");
  careful.participant.max_payload = 100'000;
  const auto hearer = make_node(careful);
  for (const Qos& qos : {kDefaultQos, kSensorQos}) {
    const std::string topic = qos.reliable ? "/reliable" : "/best_effort";
    const auto publisher = must(talker->advertise<std_msgs::String>(topic));
    const Listener listener(*hearer, topic, qos);
    ASSERT_TRUE(eventually([&] { return publisher.readers() == 1 && listener.writers() == 1; }));
    const std::int64_t before = hearer->malformed();
    ASSERT_TRUE(publisher.publish({std::string(200'000, 'x')}));
    ASSERT_TRUE(publisher.publish({"short"}));
    ASSERT_TRUE(eventually([&] { return listener.heard_last("short"); })) << topic;
    EXPECT_EQ(listener.heard().size(), 1U) << topic;
    EXPECT_TRUE(eventually([&] { return hearer->malformed() > before; })) << topic;
  }
}

TEST(Node, ListensNoMoreWhenTheSubscriptionIsGone) {
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto publisher = must(talker->advertise<std_msgs::String>("/chatter"));
  for (int round = 0; round < 5; ++round) {
    auto alive = std::make_unique<std::atomic<int>>(0);
    auto subscription = must(hearer->subscribe<std_msgs::String>(
        "/chatter", kDefaultQos,
        [count = alive.get()](std_msgs::String&&, const Guid&) { ++*count; }));
    ASSERT_TRUE(eventually([&] {
      publisher.publish({"again"});
      return *alive > 0;
    }));
    for (int i = 0; i < 20; ++i) publisher.publish({"more"});
    subscription.reset();
    alive.reset();  // a callback now would write to freed memory
  }
}

TEST(Node, OfAnotherDomainIsNotHeard) {
  NodeOptions elsewhere = options_of("elsewhere");
  elsewhere.participant.domain += 100;
  const auto stranger = make_node(elsewhere);
  const auto talker = make_node("talker");
  const auto hearer = make_node("hearer");
  const auto strange = must(stranger->advertise<std_msgs::String>("/chatter", kLatchedQos));
  strange.publish({"strange"});
  const auto publisher = must(talker->advertise<std_msgs::String>("/chatter", kLatchedQos));
  publisher.publish({"known"});
  const Listener listener(*hearer, "/chatter", kLatchedQos);
  ASSERT_TRUE(eventually([&] { return listener.heard_last("known"); }));
  EXPECT_EQ(listener.heard().size(), 1U);
  EXPECT_EQ(hearer->participant().peers().size(), 1U);
}

TEST(Node, ResolvesAndRemapsNames) {
  NodeOptions options = options_of("planner");
  options.ns = "/row_1";
  options.remaps = {{"camera/color", "/left/color"}};
  const auto node = make_node(options);
  const auto hearer = make_node("hearer");
  EXPECT_EQ(node->full_name(), "/row_1/planner");
  EXPECT_EQ(node->resolve("~/start"), "/row_1/planner/start");
  const auto publisher = must(node->advertise<std_msgs::String>("camera/color"));
  EXPECT_TRUE(eventually([&] { return hearer->publishers_of("/left/color").size() == 1; }));
  EXPECT_FALSE(node->advertise<std_msgs::String>("a b").has_value());
}

TEST(Node, OneTopicHasOneType) {
  const auto node = make_node("here");
  const auto texts = must(node->advertise<std_msgs::String>("/chatter"));
  const auto images = node->advertise<sensor_msgs::Image>("/chatter");
  ASSERT_FALSE(images.has_value());
  EXPECT_EQ(images.error().message,
            "topic rt/chatter carries std_msgs::msg::dds_::String_ here, not "
            "sensor_msgs::msg::dds_::Image_");
}

TEST(Node, WrongOptionsAreNamed) {
  NodeOptions options = options_of("1st");
  EXPECT_NE(error_of(options).find("node name '1st'"), std::string::npos);
  options = options_of("here");
  options.ns = "row";
  EXPECT_NE(error_of(options).find("namespace 'row'"), std::string::npos);
  options = options_of("here");
  options.remaps = {{"a", "b c"}};
  EXPECT_NE(error_of(options).find("remap a:=b c: name 'b c'"), std::string::npos);
  options = options_of("here");
  options.participant.domain = 233;
  EXPECT_EQ(error_of(options), "domain 233: must be 0 … 232");
  options = options_of("here");
  options.participant.interfaces = {"eth0"};
  EXPECT_EQ(error_of(options), "interfaces: 'eth0' is no IPv4 address");
  options.participant.interfaces = {"192.0.2.77"};
  EXPECT_NE(error_of(options).find("this machine has no address 192.0.2.77; it has"),
            std::string::npos);
  options = options_of("here");
  options.participant.peers = {"robot"};
  EXPECT_EQ(error_of(options), "peers: 'robot' is no IPv4 address");
}

TEST(Node, AKilledPeerMayComeBack) {
  const auto hearer = make_node("hearer");
  const Listener listener(*hearer, "/description", kLatchedQos);
  const std::string domain = std::to_string(own_domain());
  Child first({CANOPEER_ROS_PEER, domain, "first"});
  ASSERT_TRUE(eventually([&] { return listener.heard_last("first"); }));
  first.kill();
  Child second({CANOPEER_ROS_PEER, domain, "second"});
  ASSERT_TRUE(eventually([&] { return listener.heard_last("second"); }));
  second.stop();
  EXPECT_TRUE(eventually([&] { return hearer->participant().peers().empty(); }))
      << "one said that it goes, the other was missed";
  EXPECT_EQ(listener.writers(), 0U);
}

TEST(Node, WhileAListenerIsBusyOthersComeAndGo) {
  const auto hearer = make_node("hearer");
  std::promise<void> begun;
  std::promise<void> go;
  const auto listener = must(hearer->subscribe<std_msgs::String>(
      "/chatter", kDefaultQos, [&](std_msgs::String&&, const Guid&) {
        begun.set_value();
        go.get_future().wait();
      }));
  const auto talker = make_node("talker");
  const auto publisher = must(talker->advertise<std_msgs::String>("/chatter"));
  ASSERT_TRUE(eventually([&] { return publisher.readers() == 1; }));
  publisher.publish({"a long story"});
  begun.get_future().wait();
  auto other = make_node("other");
  {
    const auto another = must(other->advertise<std_msgs::String>("/chatter"));
    EXPECT_TRUE(eventually([&] { return listener->matched().size() == 2; }));
  }
  EXPECT_TRUE(eventually([&] { return listener->matched().size() == 1; }));
  other.reset();
  EXPECT_TRUE(eventually([&] { return hearer->participant().peers().size() == 1; }));
  go.set_value();
}

TEST(Node, OneThatWasMadeAnewIsFound) {
  const std::string domain = std::to_string(own_domain());
  Child peer({CANOPEER_ROS_PEER, domain, "still here"});
  for (int i = 0; i < 3; ++i) {
    const auto node = make_node("node");
    const Listener listener(*node, "/description", kLatchedQos);
    ASSERT_TRUE(eventually([&] { return listener.heard_last("still here"); })) << i;
  }
}

}  // namespace
}  // namespace canopeer::ros
