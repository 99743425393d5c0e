#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "canopeer/base/rng.h"
#include "canopeer/cdr/messages/rosgraph_msgs.h"
#include "canopeer/ros2/arm/joint_listener.h"
#include "canopeer/ros2/time/joint_history.h"
#include "canopeer/ros2/time/ros_clock.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

constexpr Stamp kBegin = 1'700'000'000'000'000'000;
using Added = JointHistory::Added;

Stamp at_s(double seconds) { return kBegin + nanoseconds(seconds); }

sensor_msgs::JointState state(double t_s, std::vector<std::string> names,
                              std::vector<double> positions) {
  sensor_msgs::JointState state;
  state.header.stamp = ros_time(at_s(t_s));
  state.name = std::move(names);
  state.position = std::move(positions);
  return state;
}

TEST(Stamps, GoThereAndBack) {
  Rng rng(1, "stamps");
  for (int i = 0; i < 1000; ++i) {
    const auto stamp = static_cast<Stamp>(rng.uniform(-2e18, 2e18));
    EXPECT_EQ(stamp_of(ros_time(stamp)), stamp);
  }
  EXPECT_EQ(ros_time(-1).sec, -1);
  EXPECT_EQ(ros_time(-1).nanosec, 999'999'999U);
}

TEST(JointHistory, InterpolatesEachJointBetweenItsOwnSamples) {
  JointHistory history({"a", "b"});
  for (int i = 0; i <= 10; ++i) history.add(0, {at_s(0.01 * i), 0.1 * i});
  for (int i = 0; i <= 2; ++i) history.add(1, {at_s(0.05 * i), 1.0 * i});
  const auto then = history.at(at_s(0.025));
  ASSERT_TRUE(then);
  EXPECT_NEAR(then->at(0), 0.25, 1e-9);
  EXPECT_NEAR(then->at(1), 0.5, 1e-9);
  EXPECT_EQ(history.at(at_s(0.1))->at(1), 2.0);
  EXPECT_FALSE(history.at(at_s(-0.01)));
  EXPECT_FALSE(history.at(at_s(0.11)));
}

TEST(JointHistory, DoesNotGuessAcrossGapsNorBeforeAllAreKnown) {
  JointHistory history({"a", "b"});
  history.add(0, {at_s(0.0), 0.0});
  EXPECT_FALSE(history.last());
  EXPECT_FALSE(history.newest());
  EXPECT_EQ(history.silent(1e9), std::vector<std::string>{"b"});
  history.add(1, {at_s(0.2), 0.0});
  history.add(0, {at_s(1.0), 1.0});
  history.add(1, {at_s(0.9), 1.0});
  EXPECT_FALSE(history.at(at_s(0.5)));
  EXPECT_TRUE(history.at(at_s(0.5), 2.0));
  EXPECT_EQ(history.oldest(), at_s(0.2));
  EXPECT_EQ(history.newest(), at_s(0.9));
}

TEST(JointHistory, DropsWhatComesLateAndForgetsWhatAnotherClockSaid) {
  JointHistory history({"a"});
  EXPECT_EQ(history.add(0, {at_s(5.0), 1.0}), Added::taken);
  EXPECT_EQ(history.add(0, {at_s(4.99), 2.0}), Added::late);
  EXPECT_EQ(history.add(0, {at_s(5.0), 2.0}), Added::late);
  EXPECT_EQ(history.last()->front(), 1.0);
  EXPECT_EQ(history.add(0, {at_s(1.0), 3.0}), Added::jumped_back);
  EXPECT_EQ(history.last()->front(), 3.0);
  EXPECT_EQ(history.oldest(), at_s(1.0));
}

TEST(JointHistory, KeepsItsSpan) {
  JointHistory history({"a"}, 1.0);
  for (int i = 0; i <= 1000; ++i) history.add(0, {at_s(0.01 * i), 0.0});
  EXPECT_EQ(history.oldest(), at_s(9.0));
  EXPECT_EQ(history.between(0, at_s(9.5), at_s(9.6)).size(), 11U);
}

TEST(JointHistory, KnowsSinceWhenNothingMoves) {
  JointHistory history({"a", "b"});
  for (int i = 0; i <= 100; ++i) {
    const double t_s = 0.01 * i;
    history.add(0, {at_s(t_s), std::min(t_s, 0.4)});
    history.add(1, {at_s(t_s), 0.0005 * std::sin(i)});
  }
  EXPECT_NEAR(seconds(*history.still_since(0.002) - kBegin), 0.4, 0.0101);
}

TEST(JointHistory, KnowsHowLongNothingWasHeard) {
  JointHistory history({"a", "b"});
  const auto now = JointHistory::Steady::now();
  history.add(0, {at_s(0.0), 0.0}, now - std::chrono::seconds(3));
  EXPECT_EQ(history.silence_s(now), std::numeric_limits<double>::infinity());
  history.add(1, {at_s(0.0), 0.0}, now - std::chrono::seconds(1));
  EXPECT_NEAR(history.silence_s(now), 3.0, 1e-9);
  EXPECT_EQ(history.silent(2.0, now), std::vector<std::string>{"a"});
}

TEST(JointListener, TakesJointsByNameInAnyOrderFromSeveral) {
  JointHistory arm({"shoulder", "elbow"});
  JointHistory trolley({"travel"});
  JointListener listener({{"elbow", "ur_elbow"}}, {&arm, &trolley}, [] { return kBegin; });
  listener.take(state(1.0, {"gripper", "ur_elbow"}, {0.0, 2.0}));
  listener.take(state(1.0, {"travel"}, {0.7}));
  EXPECT_FALSE(arm.last());
  listener.take(state(1.1, {"travel", "shoulder", "ur_elbow"}, {0.8, 1.0, 2.1}));
  EXPECT_EQ(*arm.last(), (std::vector<double>{1.0, 2.1}));
  EXPECT_EQ(*trolley.last(), std::vector<double>{0.8});
  EXPECT_EQ(listener.strangers(), std::set<std::string>{"gripper"});
}

TEST(JointListener, RefusesAndCountsWhatIsNoPosition) {
  JointHistory arm({"a", "b"});
  JointListener listener({}, {&arm}, [] { return kBegin; });
  listener.take(state(1.0, {"a", "b"}, {1.0, 2.0}));
  listener.take(state(1.1, {"a", "b"}, {std::nan(""), std::numeric_limits<double>::infinity()}));
  listener.take(state(1.2, {"a", "b"}, {1.0}));
  listener.take(state(0.9, {"a"}, {9.0}));
  listener.take(state(-9.0, {"a"}, {5.0}));
  EXPECT_EQ(*arm.last(), (std::vector<double>{5.0, 2.0}));
  const auto counts = listener.counts();
  EXPECT_EQ(counts.messages, 5);
  EXPECT_EQ(counts.not_finite, 2);
  EXPECT_EQ(counts.malformed, 1);
  EXPECT_EQ(counts.late, 1);
  EXPECT_EQ(counts.jumps_back, 1);
}

/// Somebody who repeats what another says a little later does not contradict, moving or not.
TEST(JointListener, KnowsWhoLagsFromWhoContradicts) {
  using std::chrono::milliseconds;
  JointHistory arm({"a"});
  JointListener listener({}, {&arm}, [] { return kBegin; });
  const Guid driver{1};
  const Guid other{2};
  const auto begin = JointHistory::Steady::now();
  const auto say = [&](double wrong_by) {
    static double t_s = 0.0;
    for (int i = 0; i < 200; ++i, t_s += 0.01) {
      const auto received = begin + milliseconds(static_cast<int>(1000 * t_s));
      listener.take(state(t_s, {"a"}, {t_s}), received, driver);
      listener.take(state(t_s, {"a"}, {t_s - 0.1 + wrong_by}), received + milliseconds(5), other);
    }
    return listener.contradiction(begin + milliseconds(static_cast<int>(1000 * t_s)));
  };
  EXPECT_FALSE(say(0.0));
  EXPECT_FALSE(say(0.2)) << "ahead";
  ASSERT_TRUE(say(1.0));
  EXPECT_NE(say(1.0)->find("01.00"), std::string::npos);
  EXPECT_NEAR(arm.last()->at(0), 7.99, 1e-6) << "the first is believed";
  listener.take(state(20.0, {"a"}, {5.0}), begin + milliseconds(20000), other);
  EXPECT_EQ(arm.last()->at(0), 5.0) << "who is alone is believed";
  EXPECT_FALSE(listener.contradiction(begin + milliseconds(20000)));
}

TEST(JointListener, StampsThatAreLeftOutAreNow) {
  JointHistory arm({"a"});
  JointListener listener({}, {&arm}, [] { return kBegin; });
  sensor_msgs::JointState unstamped;
  unstamped.name = {"a"};
  unstamped.position = {0.5};
  listener.take(unstamped);
  EXPECT_EQ(arm.newest(), kBegin);
}

TEST(RosClock, OnTheWallIsSteadyAndKnowsStamps) {
  Stamp system = kBegin;
  RosClock clock([&] { return system; });
  EXPECT_TRUE(clock.running());
  EXPECT_TRUE(clock.check());
  const double begun_s = clock.now_s();
  EXPECT_GE(begun_s, 0.0);
  EXPECT_LT(begun_s, 5.0);
  EXPECT_EQ(clock.now(), kBegin);
  EXPECT_NEAR(clock.mission_time_s(kBegin - nanoseconds(2.0)), clock.now_s() - 2.0, 1.0);
  clock.sleep(0.01);
  EXPECT_GE(clock.now_s(), begun_s + 0.01);
  EXPECT_FALSE(clock.simulated());
}

TEST(RosClock, SaysWhenTheSystemsTimeIsSetBack) {
  Stamp system = kBegin;
  RosClock clock([&] { return system; });
  system += nanoseconds(100.0);  // forward is harmless
  EXPECT_TRUE(clock.check());
  system -= nanoseconds(90.0);
  const auto checked = clock.check();
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("set back by 9"), std::string::npos)
      << checked.error().message;
}

TEST(RosClock, OfASimulationFollowsItsClock) {
  const auto simulator = testing_support::make_node("simulator");
  const auto node = testing_support::make_node("canopeer");
  const auto clock = must(RosClock::of_simulation(*node));
  EXPECT_FALSE(clock->running());
  EXPECT_FALSE(clock->check());
  const auto out = must(simulator->advertise<rosgraph_msgs::Clock>("/clock"));
  ASSERT_TRUE(testing_support::eventually([&] {
    out.publish({ros_time(nanoseconds(50.0))});
    return clock->running();
  }));
  EXPECT_EQ(clock->now_s(), 0.0);
  EXPECT_EQ(clock->now(), nanoseconds(50.0));
  EXPECT_TRUE(clock->check());
  EXPECT_NEAR(clock->mission_time_s(nanoseconds(48.5)), -1.5, 1e-9);

  std::jthread time([&](const std::stop_token& stop) {
    for (int i = 1; !stop.stop_requested(); ++i) {
      out.publish({ros_time(nanoseconds(50.0 + 0.1 * i))});
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  clock->sleep(3.0);  // of the simulation
  EXPECT_GE(clock->now_s(), 3.0);
}

TEST(RosClock, OfASimulationThatIsResetEndsAll) {
  const auto node = testing_support::make_node("canopeer");
  const auto clock = must(RosClock::of_simulation(*node));
  clock->take(nanoseconds(50.0));
  clock->take(nanoseconds(49.99));  // overtaken
  EXPECT_TRUE(clock->check());
  EXPECT_EQ(clock->now(), nanoseconds(50.0));
  clock->take(nanoseconds(7.0));
  const auto checked = clock->check();
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("/clock jumped back by 43.0 s"), std::string::npos);
  EXPECT_EQ(clock->now(), nanoseconds(50.0));
  clock->sleep(1e6);  // does not wait for what never comes
}

}  // namespace
}  // namespace canopeer::ros
