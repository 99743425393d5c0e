#include "canopeer/dds/node.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

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
  [[nodiscard]] std::size_t writers() const { return subscription_->matched().size(); }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> heard_;
  Subscription subscription_;
};

TEST(Node, WhatIsPublishedReachliably) {
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

}  // namespace
}  // namespace canopeer::ros
