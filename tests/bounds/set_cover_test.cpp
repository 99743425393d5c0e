#include "canopeer/bounds/set_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

/// A few sets of a few elements, drawn.
struct TinyProblem {
  explicit TinyProblem(std::uint64_t seed) {
    Rng rng(seed, "tiny cover");
    const std::size_t elements = 1 + rng.index(9);
    sets.resize(1 + rng.index(9));
    for (std::size_t e = 0; e < elements; ++e) {
      weight.push_back(static_cast<float>(rng.uniform(0.1, 2.0)));
    }
    for (auto& set : sets) {
      for (std::uint32_t e = 0; e < elements; ++e) {
        if (rng.chance(0.35)) set.push_back(e);
      }
    }
  }

  [[nodiscard]] CoverProblem problem() const {
    CoverProblem p;
    p.weight = weight;
    for (const auto& set : sets) p.sets.emplace_back(set);
    return p;
  }
  /// Weight of what the chosen sets have.
  [[nodiscard]] double weight_of(std::uint32_t choice) const {
    std::vector<char> in(weight.size(), 0);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (((choice >> s) & 1U) == 0) continue;
      for (const std::uint32_t e : sets[s]) in[e] = 1;
    }
    double sum = 0.0;
    for (std::size_t e = 0; e < in.size(); ++e) sum += in[e] != 0 ? weight[e] : 0.0F;
    return sum;
  }
  [[nodiscard]] double all() const { return weight_of((1U << sets.size()) - 1U); }
  /// Fewest sets that weigh so much together: all choices are tried.
  [[nodiscard]] int fewest(double enough) const {
    int fewest = static_cast<int>(sets.size());
    for (std::uint32_t choice = 0; choice < (1U << sets.size()); ++choice) {
      if (weight_of(choice) >= enough - 1e-6) fewest = std::min(fewest, std::popcount(choice));
    }
    return fewest;
  }

  std::vector<std::vector<std::uint32_t>> sets;
  std::vector<float> weight;
};

std::uint32_t choice_of(const Cover& cover) {
  std::uint32_t choice = 0;
  for (const std::size_t s : cover.sets) choice |= 1U << s;
  return choice;
}

TEST(SetCover, LiesBetweenItsLowerBoundAndLnTimesTheFewest) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const TinyProblem tiny(seed);
    const CoverProblem problem = tiny.problem();
    const Cover cover = greedy_cover(problem);
    EXPECT_NEAR(cover.coverable, tiny.all(), 1e-5) << seed;
    EXPECT_NEAR(tiny.weight_of(choice_of(cover)), tiny.all(), 1e-5) << seed;
    const int fewest = tiny.fewest(tiny.all());
    const int greedy = static_cast<int>(cover.sets.size());
    EXPECT_GE(greedy, fewest) << seed;
    EXPECT_LE(cover_at_least(problem), fewest) << seed;
    EXPECT_LE(greedy, 4 * std::max(1, fewest)) << seed;
  }
}

TEST(SetCover, OfAShareHasThatShareAndItsBoundHolds) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const TinyProblem tiny(seed);
    const CoverProblem problem = tiny.problem();
    for (const double share : {0.5, 0.9}) {
      const Cover cover = greedy_cover(problem, share);
      const double enough = share * tiny.all();
      EXPECT_GE(tiny.weight_of(choice_of(cover)), enough - 1e-5) << seed;
      EXPECT_LE(share_cover_at_least(problem, share), tiny.fewest(enough)) << seed;
    }
  }
}

TEST(SetCover, AlwaysTakesTheSetThatAddsMost) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const TinyProblem tiny(seed);
    const Cover cover = greedy_cover(tiny.problem());
    std::uint32_t choice = 0;
    for (const std::size_t taken : cover.sets) {
      double most = 0.0;
      for (std::size_t s = 0; s < tiny.sets.size(); ++s) {
        most = std::max(most, tiny.weight_of(choice | (1U << s)));
      }
      choice |= 1U << taken;
      EXPECT_NEAR(tiny.weight_of(choice), most, 1e-6) << seed;
    }
  }
}

TEST(SetCover, OfNothingIsEmpty) {
  EXPECT_TRUE(greedy_cover({}).sets.empty());
  EXPECT_EQ(cover_at_least({}), 0);
  EXPECT_EQ(share_cover_at_least({}, 0.9), 0);
}

TEST(PoolCover, CountsViewsForFruitsByTheFindRule) {
  // Fruit 0 has two patches of 1 cm² in two views, fruit 1 one of 3 cm² in a third.
  ViewPool pool;
  pool.patches.fruit = {0, 0, 1};
  pool.patches.area_cm2 = {1.0F, 1.0F, 3.0F};
  pool.patches.fruits_total = 2;
  pool.segments.resize(2);
  pool.segments[0].resize(2);
  pool.segments[0][0].patches = {0};
  pool.segments[0][1].patches = {1};
  pool.segments[1].resize(1);
  pool.segments[1][0].patches = {2};
  EXPECT_EQ(cover_of(pool, {2.0}).fruit_views_100, 3);
  EXPECT_EQ(cover_of(pool, {1.0}).fruit_views_100, 2);
  EXPECT_EQ(cover_of(pool, {2.5}).fruit_views_100, 1);  // fruit 0 never
  const PoolCover cover = cover_of(pool, {2.0});
  ASSERT_EQ(cover.views.size(), 3U);
  EXPECT_EQ(cover.views[0].segment, 1);
  EXPECT_EQ(cover.at_least_100, 3);
}

}  // namespace
}  // namespace canopeer
