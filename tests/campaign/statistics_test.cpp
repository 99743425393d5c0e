#include "canopeer/campaign/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

TEST(Statistics, MeanAndDeviationOfAKnownSample) {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};
  const SampleFigures f = sample_figures(values);
  EXPECT_EQ(f.count, 8U);
  EXPECT_DOUBLE_EQ(f.mean, 5.0);
  EXPECT_NEAR(f.standard_deviation, std::sqrt(32.0 / 7.0), 1e-12);
  EXPECT_LT(f.low95, 5.0);
  EXPECT_GT(f.high95, 5.0);
}

TEST(Statistics, EmptyAndConstantSamplesHaveNoSpread) {
  EXPECT_EQ(sample_figures({}).count, 0U);
  const std::vector<double> values = {3, 3, 3};
  const SampleFigures f = sample_figures(values);
  EXPECT_EQ(f.standard_deviation, 0.0);
  EXPECT_EQ(f.low95, 3.0);
  EXPECT_EQ(f.high95, 3.0);
}

TEST(Statistics, TheBootstrapIntervalHoldsTheMeanAboutAsOftenAsItSays) {
  Rng rng(7);
  int held = 0;
  constexpr int kSamples = 200;
  for (int i = 0; i < kSamples; ++i) {
    std::vector<double> values;
    for (int k = 0; k < 20; ++k) values.push_back(rng.normal(10.0, 2.0));
    const SampleFigures f = sample_figures(values);
    held += f.low95 <= 10.0 && 10.0 <= f.high95 ? 1 : 0;
  }
  // Percentile intervals of 20 values cover about 93 %; ± 4 standard errors of 200 draws.
  EXPECT_GT(held, 0.86 * kSamples);
}

TEST(Statistics, SignedRanksAndSignFlipsMatchTheirExactTables) {
  // Five pairs, all better: 2 of the 2⁵ sign choices are as extreme.
  const std::vector<double> a = {1, 1, 1, 1, 1};
  const std::vector<double> b = {2, 3, 4, 5, 6};
  const PairedFigures f = paired_figures(a, b);
  EXPECT_DOUBLE_EQ(f.difference.mean, 3.0);
  EXPECT_DOUBLE_EQ(f.p_wilcoxon.value(), 2.0 / 32.0);
  EXPECT_DOUBLE_EQ(f.p_permutation.value(), 2.0 / 32.0);
  // Differences 1, 2, 3, −4: positive ranks sum to 6 of 10; 14 of 16 choices are as far from 5.
  const std::vector<double> c = {0, 0, 0, 4};
  const std::vector<double> d = {1, 2, 3, 0};
  EXPECT_DOUBLE_EQ(paired_figures(c, d).p_wilcoxon.value(), 14.0 / 16.0);
}

TEST(Statistics, PairsThatAgreeShowNoDifference) {
  const std::vector<double> a = {1, 2, 3};
  const PairedFigures f = paired_figures(a, a);
  EXPECT_EQ(f.p_wilcoxon.value(), 1.0);
  EXPECT_EQ(f.p_permutation.value(), 1.0);
  EXPECT_FALSE(paired_figures(std::vector<double>{1}, std::vector<double>{2}).p_wilcoxon);
}

TEST(Statistics, LargeSamplesComeNearTheExactTest) {
  Rng rng(11);
  std::vector<double> a;
  std::vector<double> b;
  for (int i = 0; i < 20; ++i) {
    a.push_back(rng.normal());
    b.push_back(a.back() + rng.normal(0.5, 1.0));
  }
  const PairedFigures exact = paired_figures(a, b);
  // The same pairs and one that changes nothing: the approximations take over.
  a.push_back(0.0);
  b.push_back(0.0);
  const PairedFigures approximate = paired_figures(a, b);
  EXPECT_NEAR(approximate.p_permutation.value(), exact.p_permutation.value(), 0.01);
  EXPECT_NEAR(approximate.p_wilcoxon.value(), exact.p_wilcoxon.value(), 0.02);
}

TEST(Statistics, RankCorrelationSeesOrderOnly) {
  const std::vector<double> a = {1, 2, 3, 4};
  EXPECT_DOUBLE_EQ(rank_correlation(a, std::vector<double>{1, 10, 100, 1000}).value(), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(a, std::vector<double>{9, 7, 5, 1}).value(), -1.0);
  EXPECT_FALSE(rank_correlation(a, std::vector<double>{2, 2, 2, 2}).has_value());
}

}  // namespace
}  // namespace canopeer
