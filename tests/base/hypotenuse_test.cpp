#include "canopeer/base/hypotenuse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

TEST(Hypotenuse, IsTheRootOfBothSquares) {
  EXPECT_EQ(hypotenuse(-3.0, 4.0), 5.0);
  EXPECT_EQ(hypotenuse(0.0, -2.0), 2.0);
  EXPECT_EQ(hypotenuse(0.0, 0.0), 0.0);
  Rng rng(1, "hypotenuse");
  for (int i = 0; i < 100000; ++i) {
    const double x = rng.uniform(-1.0, 1.0), y = std::exp2(rng.uniform(-60.0, 10.0));
    const double c = hypotenuse(x, y);
    // std::hypot has an error below one unit in the last place, too.
    ASSERT_NEAR(c, std::hypot(x, y), c * 0x1p-52) << x << ' ' << y;
    ASSERT_EQ(c, hypotenuse(y, -x)) << x << ' ' << y;
  }
}

// Pinned: the same on every machine. A plain root of x² + y² ends otherwise.
TEST(Hypotenuse, HasTheSameLastDigitsEverywhere) {
  Rng rng(2, "hypotenuse");
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += hypotenuse(rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0));
  EXPECT_EQ(sum, 771.07812080193276);
}

}  // namespace
}  // namespace canopeer
