#include "canopeer/dds/log.h"

#include <gtest/gtest.h>

#include <mutex>

#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using testing_support::eventually;
using testing_support::make_node;
using testing_support::options_of;

TEST(Log, IsHeardOnRosoutByThoseWhoComeLate) {
  NodeOptions options = options_of("planner");
  options.ns = "/row_1";
  const auto node = make_node(options);
  const auto log = must(Log::make(*node, [] { return builtin_interfaces::Time{7, 8}; }));
  log.say(LogLevel::debug, "not said");
  log.say(LogLevel::warn, "the arm is slow");
  const auto late = make_node("late");
  std::mutex mutex;
  std::vector<rcl_interfaces::Log> heard;
  const Subscription listening = must(late->subscribe<rcl_interfaces::Log>(
      "/rosout", {true, true, 1000}, [&](rcl_interfaces::Log&& message, const Guid&) {
        const std::lock_guard lock(mutex);
        heard.push_back(std::move(message));
      }));
  ASSERT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return !heard.empty();
  }));
  EXPECT_EQ(heard[0].name, "row_1.planner");
  EXPECT_EQ(heard[0].level, rcl_interfaces::Log::WARN);
  EXPECT_EQ(heard[0].msg, "the arm is slow");
  EXPECT_EQ(heard[0].stamp.sec, 7);
}

TEST(Log, LevelsHaveNames) {
  EXPECT_EQ(log_level_from("error"), LogLevel::error);
  EXPECT_EQ(log_level_from("loud"), std::nullopt);
}

}  // namespace
}  // namespace canopeer::ros
