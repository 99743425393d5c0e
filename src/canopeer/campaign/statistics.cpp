#include "canopeer/campaign/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr int kResamples = 10000;
constexpr std::size_t kExactPairs = 20;
constexpr int kRandomFlips = 100000;

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of(std::span<const double> values, double mean) {
  if (values.size() < 2) return 0.0;
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Share of all sign choices whose |Σ ± weight| is at least `observed`; exact by counting sums of
/// half steps (the weights are ranks, so multiples of 0.5).
double exact_rank_p(const std::vector<double>& ranks, double observed) {
  int total = 0;
  for (const double rank : ranks) total += static_cast<int>(std::lround(2.0 * rank));
  std::vector<double> ways(static_cast<std::size_t>(total) + 1, 0.0);
  ways[0] = 1.0;
  int reached = 0;
  for (const double rank : ranks) {
    const int step = static_cast<int>(std::lround(2.0 * rank));
    reached += step;
    for (int s = reached; s >= step; --s) {
      ways[static_cast<std::size_t>(s)] += ways[static_cast<std::size_t>(s - step)];
    }
  }
  double extreme = 0.0;
  double all = 0.0;
  for (int s = 0; s <= total; ++s) {
    const double w = ways[static_cast<std::size_t>(s)];
    all += w;
    // Positive sum s/2, negative sum (total − s)/2.
    if (std::abs(s - 0.5 * total) >= observed - 1e-9) extreme += w;
  }
  return extreme / all;
}

double wilcoxon_p(std::vector<double> differences) {
  std::erase(differences, 0.0);
  if (differences.empty()) return 1.0;
  std::vector<double> sizes;
  for (const double d : differences) sizes.push_back(std::abs(d));
  const std::vector<double> ranks = ranks_of(sizes);
  double positive = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (differences[i] > 0.0) positive += ranks[i];
    sum += ranks[i];
    squares += ranks[i] * ranks[i];
  }
  const double away = std::abs(positive - 0.5 * sum);
  if (ranks.size() <= kExactPairs) return exact_rank_p(ranks, 2.0 * away);
  // Var of the positive rank sum under random signs: Σ rank² / 4.
  return std::erfc(away / std::sqrt(0.25 * squares) / std::sqrt(2.0));
}

double permutation_p(const std::vector<double>& differences, std::uint64_t seed) {
  const double observed = std::abs(std::accumulate(differences.begin(), differences.end(), 0.0));
  const double limit = observed - 1e-12 * (1.0 + observed);
  const std::size_t n = differences.size();
  std::int64_t extreme = 0;
  std::int64_t all = 0;
  const auto count = [&](std::uint64_t signs) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      sum += (signs >> i & 1U) != 0 ? -differences[i] : differences[i];
    extreme += std::abs(sum) >= limit ? 1 : 0;
    ++all;
  };
  if (n <= kExactPairs) {
    for (std::uint64_t signs = 0; signs < (std::uint64_t{1} << n); ++signs) count(signs);
  } else {
    Rng rng(seed, "sign flips");
    for (int i = 0; i < kRandomFlips; ++i) {
      double sum = 0.0;
      for (const double d : differences) sum += rng.chance(0.5) ? -d : d;
      extreme += std::abs(sum) >= limit ? 1 : 0;
      ++all;
    }
  }
  return static_cast<double>(extreme) / static_cast<double>(all);
}

}  // namespace

SampleFigures sample_figures(std::span<const double> values, std::uint64_t seed) {
  SampleFigures figures;
  figures.count = values.size();
  if (values.empty()) return figures;
  figures.mean = figures.low95 = figures.high95 = mean_of(values);
  figures.standard_deviation = deviation_of(values, figures.mean);
  if (figures.standard_deviation == 0.0) return figures;
  Rng rng(seed, "bootstrap");
  std::vector<double> means(kResamples);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[rng.index(values.size())];
    mean = sum / static_cast<double>(values.size());
  }
  std::sort(means.begin(), means.end());
  figures.low95 = means[kResamples * 25 / 1000];
  figures.high95 = means[kResamples * 975 / 1000 - 1];
  return figures;
}

PairedFigures paired_figures(std::span<const double> a, std::span<const double> b,
                             std::uint64_t seed) {
  CANOPEER_CHECK(a.size() == b.size(), "pairs");
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(b[i] - a[i]);
  PairedFigures figures;
  figures.difference = sample_figures(differences, seed);
  if (differences.size() < 2) return figures;
  figures.p_wilcoxon = wilcoxon_p(differences);
  figures.p_permutation = permutation_p(differences, seed);
  return figures;
}

}  // namespace canopeer
