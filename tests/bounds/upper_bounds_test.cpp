#include "canopeer/bounds/upper_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "canopeer/base/rng.h"
#include "canopeer/bounds/limits/motion_bound.h"
#include "canopeer/bounds/limits/segment_times.h"
#include "canopeer/mission/mission_time.h"
#include "canopeer/robot/straight_timing.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

using test::test_robot;

constexpr int kToyFruits = 8;

/// Two segments, a few views each, patches they show by chance.
struct Toy {
  MissionOptions mission;
  ViewPool pool;
  FindRule rule;
  BoundOptions options;
};

Configuration near(const Configuration& home, double spread, Rng& rng) {
  Configuration q = home;
  for (int i = 0; i < q.size(); ++i) q[i] += rng.normal(0.0, spread);
  return q;
}

Toy random_toy(Rng& rng, int number, int views) {
  Toy toy;
  toy.mission.segments.resize(2);
  toy.mission.segments[1].side = number % 3 == 0 ? 2 : 1;
  toy.mission.segments[1].trolley.travel_m = number % 2 == 0 ? 0.0 : 0.1;
  toy.mission.segment_time_s = rng.uniform(0.5, 4.0);
  toy.mission.costs[Work::detect_frame] = 0.03;
  toy.mission.costs[Work::fruit_frame] = 0.05;
  toy.mission.leave_when_done = number % 4 == 1;
  toy.mission.max_views = number % 8 == 3 ? 3 : 0;
  if (number % 5 != 0) toy.mission.mission_time_s = whole_mission_time_s(test_robot(), toy.mission);
  toy.mission.shares_time = number % 5 == 4;
  if (number % 20 == 5) toy.mission.segment_time_s = 0.0;  // they end when their planner says so
  if (number % 7 == 6) toy.mission.on_the_way.hz = 10.0;
  toy.rule.min_area_cm2 = number % 2 == 0 ? 1.5 : 0.0;
  toy.options.columns = number % 3 == 1 ? 2 : 500;
  toy.options.times = 1 + number % 3;

  FruitPatches& patches = toy.pool.patches;
  patches.fruits_total = kToyFruits + 1;  // one that nothing shows
  for (int f = 0; f < kToyFruits; ++f) {
    for (int i = 0; i < 3; ++i) {
      patches.fruit.push_back(10 * f);
      patches.area_cm2.push_back(static_cast<float>(rng.uniform(0.5, 1.5)));
    }
  }
  for (const SegmentPlan& plan : toy.mission.segments) {
    const Configuration home = segment_home(test_robot(), plan);
    toy.pool.segments.emplace_back();
    for (int v = 0; v <= views; ++v) {
      PoolView view;
      view.q = v == 0 ? home : near(home, 0.15, rng);
      for (std::uint32_t p = 0; p < patches.fruit.size(); ++p) {
        if (rng.uniform(0.0, 1.0) < 0.2) view.patches.push_back(p);
      }
      toy.pool.segments.back().push_back(view);
    }
  }
  return toy;
}

struct Find {
  double t_s = 0.0;
  const PoolView* view = nullptr;
};

/// All plans of a toy mission, as fast as its arm can be, tried one by one: what the mission does,
/// written down a second time.
class AllPlans {
 public:
  explicit AllPlans(const Toy& toy)
      : toy_(toy),
        on_the_way_(toy.mission.on_the_way.hz > 0.0),
        motion_(test_robot(), on_the_way_) {
    const MissionOptions& mission = toy.mission;
    look_s_ = mission.costs[Work::detect_frame] + mission.costs[Work::fruit_frame];
    if (mission.mission_time_s > 0.0) {
      deadlines_s_ = segment_deadlines_s(test_robot(), mission);
      if (mission.shares_time) deadlines_s_.assign(2, mission.mission_time_s);
    }
    leaves_early_ = mission.leave_when_done || mission.max_views > 0 || mission.shares_time;
    drive_s_ = axis_motion_time(mission.segments[1].trolley.travel_m,
                                test_robot().travel_axis().velocity_limit,
                                test_robot().travel_axis().acceleration_limit);
  }

  /// visit(finds by time, when the run ends) for every plan.
  template <typename Visit>
  void each(const Visit& visit) {
    begin_segment(0, 0.0, visit);
  }

 private:
  template <typename Visit>
  void begin_segment(std::size_t s, double start_s, const Visit& visit) {
    const double own_s = toy_.mission.segment_time_s;
    constexpr double kEver = std::numeric_limits<double>::infinity();
    const double own_end_s = own_s > 0.0 ? start_s + own_s : kEver;
    const double deadline_s = deadlines_s_.empty() ? own_end_s : deadlines_s_[s];
    const double end_s = deadlines_s_.empty() ? kEver : deadlines_s_.back();
    if (start_s >= end_s) return visit(finds_, end_s);
    finds_.push_back({start_s, &toy_.pool.segments[s][0]});
    const double before_s = std::exchange(segment_start_s_, start_s);
    std::vector<bool> used(toy_.pool.segments[s].size(), false);
    go_on(s, 0, start_s, deadline_s, end_s, 1, used, visit);
    segment_start_s_ = before_s;
    finds_.pop_back();
  }

  template <typename Visit>
  void go_on(std::size_t s, std::size_t at, double now_s, double deadline_s, double end_s,
             int views, std::vector<bool>& used, const Visit& visit) {
    leave(s, at, now_s, deadline_s, end_s, visit);
    const std::vector<PoolView>& all = toy_.pool.segments[s];
    const bool first = at == 0;
    const double ready_s = now_s + (on_the_way_ && !first ? 0.0 : look_s_);
    const bool full = toy_.mission.max_views > 0 && views > toy_.mission.max_views;
    if (!on_the_way_ && (ready_s >= deadline_s || full)) return;
    for (std::size_t v = 1; v < all.size(); ++v) {
      if (used[v]) continue;
      // Who passes by has sped up since home.
      const double straight_s = segment_start_s_ + look_s_ + motion_.first(all[0].q, all[v].q);
      const double there_s =
          std::max(straight_s, first ? 0.0 : ready_s + motion_.between(all[at].q, all[v].q));
      if (there_s >= end_s) continue;
      used[v] = true;
      finds_.push_back({there_s, &all[v]});
      go_on(s, v, there_s, deadline_s, end_s, views + 1, used, visit);
      finds_.pop_back();
      used[v] = false;
    }
  }

  template <typename Visit>
  void leave(std::size_t s, std::size_t at, double now_s, double deadline_s, double end_s,
             const Visit& visit) {
    const double ready_s = now_s + (on_the_way_ && at != 0 ? 0.0 : look_s_);
    const double leaves_s = leaves_early_ ? ready_s : std::max(ready_s, deadline_s);
    if (s == 1) return visit(finds_, std::isfinite(end_s) ? end_s : leaves_s);
    const Configuration home = segment_home(test_robot(), toy_.mission.segments[1]);
    // Who moves there while it waits for the deadline is there when it comes.
    const double home_s =
        std::max(leaves_s, ready_s + motion_.between(toy_.pool.segments[0][at].q, home));
    begin_segment(1, home_s + drive_s_, visit);
  }

  const Toy& toy_;
  bool on_the_way_;
  MotionBound motion_;
  double look_s_ = 0.0;
  double drive_s_ = 0.0;
  double segment_start_s_ = 0.0;  // of the present one
  bool leaves_early_ = false;
  std::vector<double> deadlines_s_;
  std::vector<Find> finds_;
};

int found_by(const Toy& toy, const std::vector<Find>& finds, std::size_t count) {
  std::vector<bool> seen(toy.pool.patches.fruit.size(), false);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint32_t p : finds[i].view->patches) seen[p] = true;
  }
  int found = 0;
  for (int f = 0; f < kToyFruits; ++f) {
    double area = 0.0;
    bool any = false;
    for (std::size_t p = 0; p < 3; ++p) {
      const std::size_t patch = 3 * static_cast<std::size_t>(f) + p;
      if (!seen[patch]) continue;
      any = true;
      area += toy.pool.patches.area_cm2[patch];
    }
    found += any && area >= toy.rule.min_area_cm2;
  }
  return found;
}

double course_at(const UpperBound& bound, double t_s) {
  double fruits = -1.0;
  for (const FruitsByTime& at : bound.course) {
    if (at.t_s <= t_s) fruits = at.fruits;
  }
  return fruits;
}

/// The best that plans can do: of fruits at the end, and of AUC.
struct Best {
  int fruits = 0;
  double auc = 0.0;
};

Best expect_no_plan_beyond(const Toy& toy, const UpperBound& bound, int number) {
  Best best;
  AllPlans plans(toy);
  plans.each([&](const std::vector<Find>& finds, double end_s) {
    double area = 0.0;
    int found = 0;
    for (std::size_t i = 0; i < finds.size(); ++i) {
      found = found_by(toy, finds, i + 1);
      ASSERT_LE(found, course_at(bound, finds[i].t_s + 1e-9)) << number << " at " << finds[i].t_s;
      const double next_s = i + 1 < finds.size() ? finds[i + 1].t_s : end_s;
      area += found * (next_s - finds[i].t_s);
    }
    best.fruits = std::max(best.fruits, found);
    best.auc = std::max(best.auc, area / (end_s * toy.pool.patches.fruits_total));
  });
  EXPECT_LE(best.fruits, *bound.fruits) << number;
  EXPECT_LE(best.auc, *bound.auc + 1e-9) << number;
  return best;
}

TEST(SampledBound, NoPlanOfAToyWorldIsBeyondIt) {
  Rng rng(1, "toys");
  int tight = 0;
  for (int number = 0; number < 1000; ++number) {
    const Toy toy = random_toy(rng, number, 2 + number % 2);
    const UpperBound bound =
        sampled_bound(toy.pool, test_robot(), toy.mission, toy.rule, toy.options);
    tight += expect_no_plan_beyond(toy, bound, number).fruits == *bound.fruits;
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tight, 300);  // it is a bound one can come near to
}

TEST(SampledBound, NorOfOneWithMoreViews) {
  Rng rng(2, "toys");
  for (int number = 0; number < 28; ++number) {
    const Toy toy = random_toy(rng, number, number % 20 == 5 ? 4 : 5);
    expect_no_plan_beyond(
        toy, sampled_bound(toy.pool, test_robot(), toy.mission, toy.rule, toy.options), number);
    if (HasFatalFailure()) return;
  }
}

TEST(SampledBound, NeverFallsWithTimeNorWithMoreOfIt) {
  Rng rng(3, "toys");
  for (int number = 0; number < 100; ++number) {
    Toy toy = random_toy(rng, number, 6);
    double before = 0.0;
    for (const double time_s : {0.5, 1.0, 2.0, 4.0, 30.0}) {
      toy.mission.segment_time_s = time_s;
      if (toy.mission.mission_time_s > 0.0) {
        toy.mission.mission_time_s = whole_mission_time_s(test_robot(), toy.mission);
      }
      const UpperBound bound =
          sampled_bound(toy.pool, test_robot(), toy.mission, toy.rule, toy.options);
      EXPECT_GE(*bound.fruits, before) << number;
      before = *bound.fruits;
      EXPECT_TRUE(std::is_sorted(
          bound.course.begin(), bound.course.end(),
          [](const auto& a, const auto& b) { return a.fruits < b.fruits && a.t_s <= b.t_s; }));
      EXPECT_LE(*bound.auc * toy.pool.patches.fruits_total, *bound.fruits + 1e-9);
    }
    EXPECT_LE(before, kToyFruits);
  }
}

TEST(SampledBound, IsTheSameEachTime) {
  Rng rng(4, "toys");
  const Toy toy = random_toy(rng, 2, 40);
  const UpperBound a = sampled_bound(toy.pool, test_robot(), toy.mission, toy.rule, toy.options);
  const UpperBound b = sampled_bound(toy.pool, test_robot(), toy.mission, toy.rule, toy.options);
  EXPECT_EQ(*a.auc, *b.auc);
  EXPECT_EQ(a.by, b.by);
}

TEST(SampledBound, OfAWorldWithoutFruitsIsNothing) {
  Toy toy;
  toy.mission.segments.resize(1);
  toy.pool.segments = {{PoolView{test_robot().home("side_1"), Pose::Identity(), {}}}};
  const UpperBound bound = sampled_bound(toy.pool, test_robot(), toy.mission, toy.rule);
  EXPECT_EQ(*bound.fruits, 0.0);
  EXPECT_FALSE(bound.auc.has_value());
}

TEST(MotionBound, NoMotionIsFasterAndDetoursAreLonger) {
  Rng rng(5, "motions");
  for (const bool on_the_way : {false, true}) {
    const MotionBound bound(test_robot(), on_the_way);
    for (int i = 0; i < 1000; ++i) {
      const Configuration a = near(test_robot().home("side_1"), 0.8, rng);
      const Configuration b = near(a, 0.8, rng);
      const Configuration c = near(b, 0.8, rng);
      EXPECT_LE(bound.between(a, b), motion_time(a, b, test_robot().limits()) + 1e-9);
      EXPECT_LE(bound.first(a, b), motion_time(a, b, test_robot().limits()) + 1e-9);
      EXPECT_LE(bound.between(a, c), bound.between(a, b) + bound.between(b, c) + 1e-9);
      for (int joint = 0; joint < a.size(); ++joint) {
        const double turn = std::abs(b[joint] - a[joint]);
        EXPECT_GE(bound.most_turn(joint, bound.first(a, b)), turn - 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace canopeer
