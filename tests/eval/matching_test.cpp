#include "canopeer/eval/matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

FruitTruth fruit_at(const Vec3& centre, bool counted = true) {
  FruitTruth fruit;
  fruit.centre = centre;
  fruit.counted = counted;
  return fruit;
}

struct Best {
  int pairs = 0;
  double distance_m = 0.0;
};

/// Tries every way to give each estimate a truth or none.
Best brute_force(const std::vector<Vec3>& centres, const std::vector<FruitTruth>& truth,
                 double reach) {
  std::vector<int> slots(truth.size() + centres.size());
  std::iota(slots.begin(), slots.end(), 0);
  Best best;
  do {
    Best now;
    for (std::size_t e = 0; e < centres.size(); ++e) {
      const auto t = static_cast<std::size_t>(slots[e]);
      if (t >= truth.size()) continue;
      const double distance = (centres[e] - truth[t].centre).norm();
      if (distance > reach) continue;
      ++now.pairs;
      now.distance_m += distance;
    }
    if (now.pairs > best.pairs || (now.pairs == best.pairs && now.distance_m < best.distance_m)) {
      best = now;
    }
  } while (std::next_permutation(slots.begin(), slots.end()));
  return best;
}

TEST(Matching, OptimalAgreesWithEveryPermutation) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    std::vector<Vec3> centres(1 + rng.index(4));
    std::vector<FruitTruth> truth(1 + rng.index(4));
    const auto somewhere = [&] {
      return Vec3{rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.05)};
    };
    for (Vec3& c : centres) c = somewhere();
    for (FruitTruth& t : truth) t = fruit_at(somewhere());
    const FruitMatching matching = match_optimal(centres, truth, 0.05);
    const Best best = brute_force(centres, truth, 0.05);
    double distance = 0.0;
    for (const FruitPair& pair : matching.pairs) distance += pair.distance_m;
    ASSERT_EQ(static_cast<int>(matching.pairs.size()), best.pairs) << "seed " << seed;
    ASSERT_NEAR(distance, best.distance_m, 1e-9) << "seed " << seed;
    ASSERT_EQ(matching.false_positives, static_cast<int>(centres.size()) - best.pairs);
  }
}

TEST(Matching, GreedyTakesTheClosestPairFirstEvenWhenThatCostsAPair) {
  const std::vector<Vec3> centres = {{0.0, 0, 0}, {0.19, 0, 0}};
  const std::vector<FruitTruth> truth = {fruit_at({0.09, 0, 0}), fruit_at({-0.15, 0, 0})};
  // The second truth is in reach of the first estimate only, which is nearest to the first truth.
  const FruitMatching greedy = match_greedy(centres, truth, 0.2);
  ASSERT_EQ(greedy.pairs.size(), 1U);
  EXPECT_EQ(greedy.pairs[0].estimate, 0);
  EXPECT_EQ(greedy.pairs[0].truth, 0);
  EXPECT_EQ(greedy.false_positives, 1);
  EXPECT_EQ(match_optimal(centres, truth, 0.2).pairs.size(), 2U);
}

TEST(Matching, AnEstimateOfAnUncountedFruitIsNeitherDetectedNorFalse) {
  const std::vector<Vec3> centres = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<FruitTruth> truth = {fruit_at({0, 0, 0.01}), fruit_at({1, 0, 0.01}, false)};
  for (const FruitMatching& m : {match_greedy(centres, truth), match_optimal(centres, truth)}) {
    EXPECT_EQ(m.pairs.size(), 1U);
    EXPECT_EQ(m.ignored, 1);
    EXPECT_EQ(m.false_positives, 1);
  }
}

TEST(Matching, ReachIsInclusiveAndEmptyListsAreFine) {
  const std::vector<Vec3> centres = {{0, 0, 0}};
  const std::vector<FruitTruth> truth = {fruit_at({0.5, 0, 0})};
  EXPECT_EQ(match_optimal(centres, truth, 0.5).pairs.size(), 1U);
  EXPECT_EQ(match_greedy(centres, truth, 0.5).pairs.size(), 1U);
  EXPECT_EQ(match_optimal(centres, truth, 0.499).pairs.size(), 0U);
  EXPECT_EQ(match_optimal({}, truth).false_positives, 0);
  EXPECT_EQ(match_greedy(centres, {}).false_positives, 1);
}

}  // namespace
}  // namespace canopeer
