#include "canopeer/base/log_exp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr int kTrials = 20000;
constexpr double kUnit = 2.220446049250313e-16;  // 2⁻⁵²

double worst_log_error(double low, double high) {
  Rng rng(1);
  double worst = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    double x[4];
    double y[4];
    for (double& value : x) value = std::exp(rng.uniform(low, high));
    store_lanes(log_of(load_lanes<FourDoubles>(x)), y);
    for (int k = 0; k < 4; ++k) {
      const double right = std::log(x[k]);
      worst = std::max(worst, std::abs(y[k] - right) / std::max(std::abs(right), 1e-3));
    }
  }
  return worst;
}

TEST(LogExp, LogarithmsAreRightToTwoUnitsInTheLastPlace) {
  EXPECT_LT(worst_log_error(-700.0, 700.0), 2.0 * kUnit);
  EXPECT_LT(worst_log_error(-1.0, 1.0), 2.0 * kUnit);
}

TEST(LogExp, ExponentialsAreRightToTwoUnitsInTheLastPlace) {
  Rng rng(2);
  double worst = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    double x[4];
    double y[4];
    for (double& value : x) value = rng.uniform(-700.0, 700.0) * (i % 2 == 0 ? 1.0 : 0.01);
    store_lanes(exp_of(load_lanes<FourDoubles>(x)), y);
    for (int k = 0; k < 4; ++k) {
      const double right = std::exp(x[k]);
      worst = std::max(worst, std::abs(y[k] - right) / right);
    }
  }
  EXPECT_LT(worst, 2.0 * kUnit);
}

TEST(LogExp, ExponentialsStayPositiveAndFinite) {
  const double x[4] = {-1e300, -709.0, 709.0, 1e300};
  double y[4];
  store_lanes(exp_of(load_lanes<FourDoubles>(x)), y);
  for (const double value : y) {
    EXPECT_TRUE(std::isnormal(value));
    EXPECT_GT(value, 0.0);
  }
  EXPECT_LT(y[1], 1e-300);
  EXPECT_GT(y[2], 1e300);
}

TEST(LogExp, KnowTheirFixedPoints) {
  const double x[4] = {1.0, 2.0, 0.5, 2.2250738585072014e-308};
  double y[4];
  store_lanes(log_of(load_lanes<FourDoubles>(x)), y);
  EXPECT_EQ(y[0], 0.0);
  EXPECT_DOUBLE_EQ(y[1], std::log(2.0));
  EXPECT_DOUBLE_EQ(y[2], -std::log(2.0));
  EXPECT_DOUBLE_EQ(y[3], std::log(x[3]));
  const double zero[4] = {};
  store_lanes(exp_of(load_lanes<FourDoubles>(zero)), y);
  EXPECT_EQ(y[0], 1.0);
}

TEST(SimdVectors, TellWhichLanesHold) {
  const float values[8] = {1, -1, 2, -3, -4, 5, 6, -7};
  EXPECT_EQ(lane_bits(load_lanes<EightFloats>(values) < 0.0F), 0b10011010U);
  EXPECT_EQ(lane_bits(load_lanes<FourFloats>(values) < 0.0F), 0b1010U);
  const EightFloats eight =
      joined(load_lanes<FourFloats>(values), load_lanes<FourFloats>(values + 4));
  EXPECT_EQ(high_half(eight)[3], -7.0F);
  EXPECT_EQ(low_half(eight)[1], -1.0F);
}

}  // namespace
}  // namespace canopeer
