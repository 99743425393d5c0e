#include "canopeer/base/rng.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace canopeer {
namespace {

TEST(Rng, SameSeedAndStreamGiveTheSameNumbers) {
  Rng a(7, "plant", 3);
  Rng b(7, "plant", 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(Rng, StreamsDiffer) {
  EXPECT_NE(Rng(7, "plant", 3).bits(), Rng(7, "plant", 4).bits());
  EXPECT_NE(Rng(7, "plant", 3).bits(), Rng(7, "view", 3).bits());
  EXPECT_NE(Rng(7, "plant", 3).bits(), Rng(8, "plant", 3).bits());
}

TEST(Rng, UniformAndNormalHaveTheirMoments) {
  Rng rng(1);
  constexpr int kDraws = 200000;
  double uniform_sum = 0.0;
  double normal_sum = 0.0;
  double normal_squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = rng.uniform(2.0, 4.0);
    ASSERT_GE(u, 2.0);
    ASSERT_LT(u, 4.0);
    uniform_sum += u;
    const double n = rng.normal(1.0, 2.0);
    normal_sum += n;
    normal_squares += (n - 1.0) * (n - 1.0);
  }
  // Five standard errors: 2/√12/√n and 2/√n.
  EXPECT_NEAR(uniform_sum / kDraws, 3.0, 5.0 * 0.577 / std::sqrt(kDraws));
  EXPECT_NEAR(normal_sum / kDraws, 1.0, 5.0 * 2.0 / std::sqrt(kDraws));
  EXPECT_NEAR(normal_squares / kDraws, 4.0, 0.1);
}

TEST(Rng, IndexReachesEveryValueAlike) {
  Rng rng(5);
  std::array<int, 7> counts{};
  constexpr int kDraws = 70000;
  for (int i = 0; i < kDraws; ++i) ++counts[rng.index(counts.size())];
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 7, 5 * 93);  // √(n·p·(1−p)) = 93
}

}  // namespace
}  // namespace canopeer
