#include "canopeer/mission/events/event_hub.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <stdexcept>

namespace canopeer {
namespace {

SegmentEnded numbered(int number) { return {number, 0.0}; }

/// Keeps the numbers it is told; waits at a gate before each.
class GatedWatcher : public Watcher {
 public:
  void on_event(const Event& event) override {
    std::unique_lock lock(mutex);
    changed.wait(lock, [this] { return open; });
    seen.push_back(std::get<SegmentEnded>(event).segment);
  }
  void on_loss(std::int64_t events) override { told_lost += events; }
  void open_gate() {
    const std::lock_guard<std::mutex> lock(mutex);
    open = true;
    changed.notify_all();
  }

  std::mutex mutex;
  std::condition_variable changed;
  bool open = false;
  std::vector<int> seen;
  std::int64_t told_lost = 0;
};

class CountingKeeper : public Keeper {
 public:
  explicit CountingKeeper(std::string failure = "") : failure_(std::move(failure)) {}
  Expected<void> on_event(const Event&) override {
    ++events;
    if (!failure_.empty()) return fail(failure_);
    return {};
  }
  int events = 0;

 private:
  std::string failure_;
};

class FailingWatcher : public Watcher {
 public:
  void on_event(const Event&) override { throw std::runtime_error("browser gone"); }
};

TEST(EventHub, AllKeepersGetAnEventAndTheFirstErrorComesBack) {
  CountingKeeper first("no room");
  CountingKeeper second("no paper");
  CountingKeeper third;
  EventHub hub;
  for (Keeper* keeper : {&first, &second, &third}) hub.keep(*keeper);
  const auto outcome = hub.emit(numbered(1));
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().message, "no room");
  EXPECT_EQ(third.events, 1);
}

TEST(EventHub, ASlowWatcherLosesTheOldestEventsAndIsToldHowMany) {
  EventHub hub;
  const auto watcher = std::make_shared<GatedWatcher>();
  hub.watch(watcher, {.name = "slow", .queue = 4}, true);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
  watcher->open_gate();
  hub.finish(std::chrono::seconds(60));
  const auto watched = hub.watched().front();
  // One may have been in its hands when the gate was closed; the newest four are never lost.
  EXPECT_LE(watcher->seen.size(), 5U);
  ASSERT_GE(watcher->seen.size(), 4U);
  EXPECT_EQ(watcher->seen.back(), 99);
  EXPECT_EQ(watched.lost, 100 - static_cast<std::int64_t>(watcher->seen.size()));
  EXPECT_EQ(watcher->told_lost, watched.lost);
  EXPECT_FALSE(watched.left_behind);
}

TEST(EventHub, ARecordingMakesSimulatedTimeWaitAndLosesNothing) {
  EventHub hub;
  const auto watcher = std::make_shared<GatedWatcher>();
  watcher->open_gate();
  hub.watch(watcher, {.name = "tape", .queue = 2, .wait_in_simulated_time = true}, true);
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
  hub.finish(std::chrono::seconds(60));
  EXPECT_EQ(watcher->seen.size(), 1000U);
  EXPECT_EQ(hub.watched().front().lost, 0);
}

TEST(EventHub, OnTheWallClockTheSameRecordingDropsAndCounts) {
  EventHub hub;
  const auto watcher = std::make_shared<GatedWatcher>();
  hub.watch(watcher, {.name = "tape", .queue = 2, .wait_in_simulated_time = true}, false);
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
  watcher->open_gate();
  hub.finish(std::chrono::seconds(60));
  EXPECT_GE(hub.watched().front().lost, 997);
}

TEST(EventHub, AWatcherThatNeverComesBackDoesNotHoldTheRun) {
  const auto watcher = std::make_shared<GatedWatcher>();
  {
    EventHub hub;
    hub.watch(watcher, {.name = "stuck"}, true);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
    hub.finish(std::chrono::milliseconds(10));
    EXPECT_TRUE(hub.watched().front().left_behind);
    ASSERT_TRUE(hub.emit(numbered(11)).has_value());
  }
  watcher->open_gate();  // its thread ends by itself
}

TEST(EventHub, AWatcherThatNeverComesBackTakesNothingFromTheOthers) {
  const auto stuck = std::make_shared<GatedWatcher>();
  const auto tape = std::make_shared<GatedWatcher>();
  tape->open_gate();
  {
    EventHub hub;
    hub.watch(stuck, {.name = "stuck"}, true);
    hub.watch(tape, {.name = "tape", .wait_in_simulated_time = true}, true);
    for (int i = 0; i < 200; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
    hub.finish(std::chrono::milliseconds(1));
    EXPECT_TRUE(hub.watched()[0].left_behind);
    EXPECT_FALSE(hub.watched()[1].left_behind);
    EXPECT_EQ(tape->seen.size(), 200U);  // waited for as long as it takes
  }
  stuck->open_gate();
}

TEST(EventHub, AQueueOfNoLengthHoldsOneEvent) {
  EventHub hub;
  const auto watcher = std::make_shared<GatedWatcher>();
  hub.watch(watcher, {.name = "tiny", .queue = 0}, true);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
  watcher->open_gate();
  hub.finish(std::chrono::seconds(60));
  EXPECT_EQ(watcher->seen.back(), 9);
}

TEST(EventHub, AWatcherThatThrowsIsLetGo) {
  EventHub hub;
  hub.watch(std::make_shared<FailingWatcher>(), {.name = "page"}, true);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(hub.emit(numbered(i)).has_value());
  hub.finish(std::chrono::seconds(60));
  const auto watched = hub.watched().front();
  EXPECT_EQ(watched.name, "page");
  EXPECT_EQ(watched.failure, "browser gone");
}

}  // namespace
}  // namespace canopeer
