#include "canopeer/mission/segment/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

namespace canopeer {
namespace {

/// Time that does not pass by itself.
class StillClock : public Clock {
 public:
  double now_s() const override { return now; }
  void charge(double seconds) override { now += seconds; }
  void sleep(double seconds) override { now += seconds; }
  double now = 0.0;
};

/// Makes tasks without end and notices when they run when they must not.
class BusyPlanner : public Planner {
 public:
  struct Task : BackgroundTask {
    explicit Task(BusyPlanner& p) : planner(p) {}
    void run() override {
      ++planner.running;
      if (planner.map_changes) planner.ran_beside_change = true;
      --planner.running;
    }
    BusyPlanner& planner;
  };

  void begin_segment(const PlanningScene&) override {}
  Decision decide(const Configuration&, WorkMeter&) override { return {}; }
  void time_passes(double seconds) override { told_s += seconds; }
  std::unique_ptr<BackgroundTask> next_task() override { return std::make_unique<Task>(*this); }
  void finish_task(BackgroundTask&, WorkMeter& work) override {
    work.add(Work::candidate);
    ++finished;
  }

  std::atomic<int> running{0};
  std::atomic<int> finished{0};
  std::atomic<bool> map_changes{false};
  std::atomic<bool> ran_beside_change{false};
  double told_s = 0.0;
};

void wait_for_tasks(const BusyPlanner& planner, int more) {
  const int goal = planner.finished + more;
  while (planner.finished < goal) std::this_thread::yield();
}

TEST(Background, WithoutWorkersTheWorkIsDoneInTheCallThatSaysHowMuchTimePasses) {
  BusyPlanner planner;
  StillClock clock;
  WorkMeter work;
  Background background(planner, clock, 0, work);
  background.go();
  background.time_passes(0.7);
  EXPECT_EQ(planner.told_s, 0.7);
  EXPECT_EQ(planner.finished, 0);
}

TEST(Background, WorkersMakeTasksBesideThePlannersCallsButNeverBesideAChangeOfTheMap) {
  BusyPlanner planner;
  StillClock clock;
  WorkMeter work;
  Background background(planner, clock, 2, work);
  background.go();
  for (int i = 0; i < 50; ++i) {
    wait_for_tasks(planner, 3);
    background.alone([&](Planner&) {
      EXPECT_EQ(planner.running, 0);
      planner.map_changes = true;
      std::this_thread::yield();
      planner.map_changes = false;
    });
  }
  EXPECT_FALSE(planner.ran_beside_change);
  background.rest();
  EXPECT_EQ(work.units(Work::candidate), planner.finished);
}

TEST(Background, BetweenSegmentsNoTaskIsMade) {
  BusyPlanner planner;
  StillClock clock;
  WorkMeter work;
  Background background(planner, clock, 2, work);
  background.alone([](Planner&) {});  // does not wake anybody
  background.go();
  wait_for_tasks(planner, 5);
  background.rest();
  const int finished = planner.finished;
  for (int i = 0; i < 100; ++i) std::this_thread::yield();
  EXPECT_EQ(planner.finished, finished);
}

TEST(Background, AHoldIsQuietAndItsTimeIsNotTold) {
  BusyPlanner planner;
  StillClock clock;
  WorkMeter work;
  Background background(planner, clock, 1, work);
  background.go();
  wait_for_tasks(planner, 2);
  background.hold();
  const int finished = planner.finished;
  for (int i = 0; i < 100; ++i) std::this_thread::yield();
  EXPECT_EQ(planner.finished, finished);
  clock.now = 60.0;
  background.resume();
  wait_for_tasks(planner, 2);
  clock.now = 60.5;
  background.time_passes(99.0);
  EXPECT_EQ(planner.told_s, 0.5);
}

TEST(Background, OnTheWallClockThePlannerIsToldTheTimeThatReallyPassed) {
  BusyPlanner planner;
  StillClock clock;
  WorkMeter work;
  Background background(planner, clock, 1, work);
  clock.now = 0.25;
  background.time_passes(99.0);  // what the cost table says does not count
  clock.now = 0.75;
  background.time_passes(99.0);
  EXPECT_EQ(planner.told_s, 0.75);
}

}  // namespace
}  // namespace canopeer
