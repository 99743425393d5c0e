#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "canopeer/bounds/tours/tour_search.h"
#include "toy_tours.h"

namespace canopeer {
namespace {

using test::make_toy;
using test::Toy;

bool all_free(Toy& toy, std::size_t segment, const std::vector<int>& order) {
  int at = 0;
  for (const int view : order) {
    if (toy.motions.blocked.count({static_cast<int>(segment), at, view}) > 0) return false;
    at = view;
  }
  return true;
}

/// Every order of every set of views of a segment.
std::vector<std::vector<int>> every_order(std::size_t views) {
  std::vector<std::vector<int>> orders = {{}};
  for (std::size_t done = 0; done < orders.size(); ++done) {
    for (int v = 1; v < static_cast<int>(views); ++v) {
      const std::vector<int> before = orders[done];
      if (std::find(before.begin(), before.end(), v) != before.end()) continue;
      orders.push_back(before);
      orders.back().push_back(v);
    }
  }
  return orders;
}

/// By looking at all tours.
double best_score(Toy& toy) {
  double best = 0.0;
  Tour tour(toy.problem.segments.size());
  const std::function<void(std::size_t)> from = [&](std::size_t segment) {
    if (segment == tour.size()) {
      const TourOutcome outcome = outcome_of(toy.problem, tour);
      if (outcome.possible) best = std::max(best, outcome.score);
      return;
    }
    for (const auto& order : every_order(toy.problem.segments[segment].size())) {
      if (!all_free(toy, segment, order)) continue;
      tour[segment] = order;
      from(segment + 1);
    }
  };
  from(0);
  return best;
}

/// What any tour that is given back has to be.
void expect_good(Toy& toy, const Tour& tour) {
  ASSERT_EQ(tour.size(), toy.problem.segments.size());
  ASSERT_TRUE(outcome_of(toy.problem, tour).possible);
  for (std::size_t s = 0; s < tour.size(); ++s) {
    EXPECT_TRUE(all_free(toy, s, tour[s])) << "segment " << s;
    for (const int view : tour[s]) EXPECT_EQ(std::count(tour[s].begin(), tour[s].end(), view), 1);
  }
}

struct Gaps {
  int toys = 0;
  int optimal = 0;
  int close = 0;  ///< within 1.5 %
  double largest = 0.0;
};

Gaps gaps_to_the_best(int toys, int segments, int views, int fruits) {
  Gaps gaps;
  for (int i = 0; i < toys; ++i) {
    Toy toy;
    make_toy(toy, static_cast<std::uint64_t>(i), segments, views, fruits);
    const double best = best_score(toy);
    const Tour tour = best_tour(toy.problem, {});
    expect_good(toy, tour);
    const double score = outcome_of(toy.problem, tour).score;
    EXPECT_LE(score, best + 1e-9) << "toy " << i;
    ++gaps.toys;
    gaps.optimal += score >= best - 1e-7 ? 1 : 0;
    gaps.close += score >= 0.985 * best ? 1 : 0;
    gaps.largest = std::max(gaps.largest, 1.0 - score / best);
  }
  return gaps;
}

TEST(Tours, OfOneSegmentAreTheBestOfAllOrders) {
  const Gaps gaps = gaps_to_the_best(150, 1, 7, 8);
  EXPECT_GE(gaps.optimal, 0.95 * gaps.toys) << "largest gap " << gaps.largest;
  EXPECT_LT(gaps.largest, 0.05);
}

TEST(Tours, OfTwoSegmentsAreTheBestOfAllOrdersOrNearlySo) {
  const Gaps gaps = gaps_to_the_best(150, 2, 5, 8);
  EXPECT_GE(gaps.close, 0.95 * gaps.toys) << "largest gap " << gaps.largest;
  EXPECT_GE(gaps.optimal, 0.85 * gaps.toys) << "largest gap " << gaps.largest;
  EXPECT_LT(gaps.largest, 0.1);
}

TEST(Tours, AreNeverWorseThanGreedyAndAlwaysTheSame) {
  for (int i = 0; i < 6; ++i) {
    Toy toy;
    make_toy(toy, 1000 + static_cast<std::uint64_t>(i), 4, 30, 25);
    const Tour greedy = greedy_tour(toy.problem);
    expect_good(toy, greedy);
    const Tour tour = best_tour(toy.problem, {});
    expect_good(toy, tour);
    EXPECT_GE(outcome_of(toy.problem, tour).score, outcome_of(toy.problem, greedy).score);
    Toy again;
    make_toy(again, 1000 + static_cast<std::uint64_t>(i), 4, 30, 25);
    EXPECT_EQ(best_tour(again.problem, {}), tour);
  }
}

TEST(Tours, OfMoreTimeAreNoWorse) {
  for (int i = 0; i < 10; ++i) {
    double before = 0.0;
    for (const double budget_s : {1.0, 3.0, 9.0}) {
      Toy toy;
      make_toy(toy, static_cast<std::uint64_t>(i), 1, 12, 12);
      toy.problem.clock = {};
      toy.problem.clock.budget_s = {budget_s};
      toy.problem.clock.observe_s = 0.1;
      const double score = outcome_of(toy.problem, best_tour(toy.problem, {})).score;
      EXPECT_GE(score, before - 1e-9);
      before = score;
    }
  }
}

TEST(Tours, WithoutATimeLimitTakeTheViewsTheProtocolAllows) {
  Toy toy;
  make_toy(toy, 1, 2, 20, 30);
  toy.problem.clock = {};
  toy.problem.clock.budget_s.assign(2, std::numeric_limits<double>::infinity());
  toy.problem.clock.observe_s = 0.1;
  toy.problem.clock.max_views = {5, 5};
  const Tour tour = best_tour(toy.problem, {});
  expect_good(toy, tour);
  EXPECT_EQ(tour[0].size(), 4U);  // and that at home
  EXPECT_LE(tour[1].size(), 4U);
}

TEST(TourSchedule, AMotionSetOutForInTimeIsFinishedAndItsFrameCounts) {
  Toy toy;
  make_toy(toy, 3, 1, 3, 4);
  toy.motions.points = {{{0.0, 0.0}, {1.0, 0.0}, {6.0, 0.0}}};
  toy.motions.blocked.clear();
  toy.problem.clock = {};
  toy.problem.clock.budget_s = {1.3};
  toy.problem.clock.observe_s = 0.1;
  const TourOutcome late = outcome_of(toy.problem, {{1, 2}});
  ASSERT_TRUE(late.possible);  // at home until 0.1, there at 1.1, on at 1.2
  EXPECT_NEAR(late.times_s[0][1], 1.1, 1e-12);
  EXPECT_NEAR(late.times_s[0][2], 6.2, 1e-12);
  EXPECT_NEAR(late.end_s, 6.3 + 0.5 + 6.0, 1e-12);
  toy.problem.clock.budget_s = {1.2};
  EXPECT_FALSE(outcome_of(toy.problem, {{1, 2}}).possible);
  toy.problem.clock.deadline_s = {4.0};  // nothing counts after the mission's end
  EXPECT_FALSE(outcome_of(toy.problem, {{1, 2}}).possible);
  EXPECT_TRUE(outcome_of(toy.problem, {{1}}).possible);
}

TEST(TourSchedule, WhoIsLateTakesFromTheNextSegment) {
  Toy toy;
  make_toy(toy, 3, 2, 2, 4);
  toy.motions.points = {{{0.0, 0.0}, {3.0, 0.0}}, {{0.0, 0.0}, {1.0, 0.0}}};
  toy.motions.blocked.clear();
  toy.problem.clock = {};
  toy.problem.clock.observe_s = 0.1;
  toy.problem.clock.budget_s = {1.0, 1.0};
  toy.problem.clock.deadline_s = {2.0, 8.0};
  // There at 3.1, home again at 6.7: the second segment has 1.3 s.
  const TourOutcome both = outcome_of(toy.problem, {{1}, {1}});
  ASSERT_TRUE(both.possible);
  EXPECT_NEAR(both.times_s[1][0], 3.2 + 0.5 + 3.0, 1e-12);
  toy.problem.clock.deadline_s = {2.0, 7.5};
  EXPECT_FALSE(outcome_of(toy.problem, {{1}, {1}}).possible);
  EXPECT_TRUE(outcome_of(toy.problem, {{1}, {}}).possible);
  EXPECT_TRUE(outcome_of(toy.problem, {{}, {1}}).possible);
}

TEST(TourCoverage, AddsUpWhatSeveralViewsShowOfAFruitWithoutCountingTwice) {
  Toy toy;
  make_toy(toy, 3, 1, 3, 2);
  const std::vector<int> fruit_of = {0, 0, 0, 0, 1, 1, 1, 1};
  const auto view = [&](std::vector<std::uint32_t> patches) {
    return make_tour_view(std::move(patches), fruit_of, toy.problem.patch_cm2);
  };
  TourCoverage seen(toy.problem);
  const TourView first = view({0, 4});
  EXPECT_NEAR(seen.gain(first, 2.0, nullptr), 2.0 * 2.0 * seen.worth(0, 1.0), 1e-12);
  seen.add(first);
  EXPECT_FALSE(seen.found(0));
  EXPECT_EQ(seen.gain(first, 1.0, nullptr), 0.0);
  const TourView second = view({0, 1});
  const double later[] = {0.25, 0.0};
  EXPECT_NEAR(seen.gain(second, 1.0, later), 0.75 * (seen.worth(0, 2.0) - seen.worth(0, 1.0)),
              1e-12);
  const double gain = seen.gain(second, 1.0, nullptr);
  EXPECT_NEAR(seen.add(second), gain, 1e-12);
  EXPECT_TRUE(seen.found(0));
  EXPECT_NEAR(seen.area_cm2(0), 2.0, 1e-12);
  EXPECT_EQ(seen.worth(0, 0.0), 0.0);
  EXPECT_NEAR(seen.worth(0, 8.0), 1.0, 1e-12);
  EXPECT_LT(seen.worth(0, 1.99), 0.05);
  EXPECT_GT(seen.worth(0, 2.0), 0.85);
}

}  // namespace
}  // namespace canopeer
