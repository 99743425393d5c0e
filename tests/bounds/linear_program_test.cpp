#include "canopeer/bounds/limits/linear_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "canopeer/base/rng.h"
#include "canopeer/bounds/limits/marginals.h"

namespace canopeer {
namespace {

/// A small program and the best of its 0/1 solutions, by trying all.
struct Small {
  LinearProgram program;
  double best = 0.0;
};

Small random_small(Rng& rng) {
  Small small;
  const int rows = 1 + static_cast<int>(rng.uniform(0.0, 4.0));
  const int columns = 1 + static_cast<int>(rng.uniform(0.0, 9.0));
  std::vector<double> rhs;
  for (int i = 0; i < rows; ++i) rhs.push_back(rng.uniform(0.5, 4.0));
  for (const double b : rhs) small.program.add_row(b);
  std::vector<double> objective;
  std::vector<std::vector<double>> a;
  for (int j = 0; j < columns; ++j) {
    objective.push_back(rng.uniform(-0.2, 2.0));
    a.emplace_back();
    std::vector<LinearProgram::Entry> entries;
    for (int i = 0; i < rows; ++i) {
      a.back().push_back(rng.uniform(0.0, 1.0) < 0.7 ? rng.uniform(-0.5, 2.0) : 0.0);
      if (a.back().back() != 0.0) entries.emplace_back(i, a.back().back());
    }
    small.program.add_column(objective.back(), 0.0, 1.0, entries);
  }
  for (unsigned x = 0; x < 1U << columns; ++x) {
    double value = 0.0;
    std::vector<double> sum(rhs.size(), 0.0);
    for (std::size_t j = 0; j < objective.size(); ++j) {
      if ((x >> j & 1U) == 0) continue;
      value += objective[j];
      for (std::size_t i = 0; i < rhs.size(); ++i) sum[i] += a[j][i];
    }
    const bool feasible =
        std::equal(sum.begin(), sum.end(), rhs.begin(), [](double s, double b) { return s <= b; });
    if (feasible) small.best = std::max(small.best, value);
  }
  return small;
}

TEST(LinearProgram, IsNeverBelowTheBestOfAllZeroOneSolutions) {
  Rng rng(1, "programs");
  for (int i = 0; i < 2000; ++i) {
    const Small small = random_small(rng);
    const double bound = small.program.bound(1000);
    EXPECT_GE(bound, small.best - 1e-9) << i;
    const std::vector<double> nothing(static_cast<std::size_t>(small.program.rows()), 0.0);
    EXPECT_LE(bound, small.program.bound_of(nothing) + 1e-9) << i;
  }
}

TEST(LinearProgram, AnyPricesProveABound) {
  Rng rng(2, "programs");
  for (int i = 0; i < 1000; ++i) {
    const Small small = random_small(rng);
    std::vector<double> y;
    for (int row = 0; row < small.program.rows(); ++row) y.push_back(rng.uniform(-1.0, 3.0));
    EXPECT_GE(small.program.bound_of(y), small.best - 1e-9) << i;
    EXPECT_GE(small.program.bound(1), small.best - 1e-9) << i;  // a simplex cut short
  }
}

/// Whose vertices are whole: workers and jobs, each once.
TEST(LinearProgram, FindsTheBestAssignment) {
  Rng rng(3, "assignments");
  for (int i = 0; i < 200; ++i) {
    constexpr int kSize = 4;
    LinearProgram program;
    for (int row = 0; row < 2 * kSize; ++row) program.add_row(1.0);
    double worth[kSize][kSize];
    for (int a = 0; a < kSize; ++a) {
      for (int b = 0; b < kSize; ++b) {
        worth[a][b] = rng.uniform(0.0, 1.0);
        const LinearProgram::Entry entries[] = {{a, 1.0}, {kSize + b, 1.0}};
        program.add_column(worth[a][b], 0.0, 1.0, entries);
      }
    }
    int job[kSize] = {0, 1, 2, 3};
    double best = 0.0;
    do {
      double sum = 0.0;
      for (int a = 0; a < kSize; ++a) sum += worth[a][job[a]];
      best = std::max(best, sum);
    } while (std::next_permutation(job, job + kSize));
    EXPECT_NEAR(program.bound(1000), best, 1e-6);
  }
}

/// Columns without a world: shares, costs, budgets.
TEST(Marginals, AreNeverBelowTheBestOfAllPlans) {
  Rng rng(4, "columns");
  constexpr int kFruits = 6;
  for (int i = 0; i < 1000; ++i) {
    std::vector<SegmentColumns> segments;
    for (int s = 0; s < 2; ++s) {
      SegmentColumns segment{
          {FruitSet(kFruits), FruitSet(kFruits), std::vector<float>(kFruits)}, {}, 0.0};
      segment.home.share[static_cast<std::size_t>(rng.uniform(0.0, kFruits))] = 0.4F;
      for (int j = 0; j < 5; ++j) {
        VisitColumn column{rng.uniform(0.2, 2.0), 1.0, {}};
        for (int f = 0; f < kFruits; ++f) {
          if (rng.uniform(0.0, 1.0) < 0.4) {
            column.shares.emplace_back(f, rng.uniform(0.0, 1.0) < 0.5 ? 1.0F : 0.6F);
          }
        }
        segment.columns.push_back(column);
      }
      segments.push_back(segment);
    }
    const double budgets[] = {rng.uniform(0.5, 4.0), rng.uniform(0.5, 4.0)};
    int best = 0;
    for (unsigned plan = 0; plan < 1U << 10; ++plan) {
      double cost[2] = {0.0, 0.0};
      double sum[kFruits] = {};
      for (int s = 0; s < 2; ++s) {
        const SegmentColumns& segment = segments[static_cast<std::size_t>(s)];
        for (int f = 0; f < kFruits; ++f) {
          sum[f] += segment.home.share[static_cast<std::size_t>(f)];
        }
        for (int j = 0; j < 5; ++j) {
          if ((plan >> (5 * s + j) & 1U) == 0) continue;
          const VisitColumn& column = segment.columns[static_cast<std::size_t>(j)];
          cost[s] += column.cost_s;
          for (const auto& [f, share] : column.shares) sum[f] += share;
        }
      }
      if (cost[0] > budgets[0] || cost[1] > budgets[1]) continue;
      best = std::max(best, static_cast<int>(std::count_if(
                                sum, sum + kFruits, [](double x) { return x >= 1.0 - 1e-6; })));
    }
    const Marginals marginals(segments, kFruits);
    EXPECT_GE(marginals.bound(budgets, std::vector<bool>(kFruits, true)), best - 1e-5) << i;
  }
}

}  // namespace
}  // namespace canopeer
