#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "canopeer/base/rank_correlation.h"

namespace canopeer {

/// A sample in figures. All zero for an empty sample; no spread and no interval for one value.
struct SampleFigures {
  std::size_t count = 0;
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the sample, n − 1
  double low95 = 0.0;               ///< 95 % interval of the mean
  double high95 = 0.0;
};

/// The interval is the percentile bootstrap of the mean (Efron & Tibshirani 1993), 10 000
/// resamples, seeded: the same sample gives the same interval.
[[nodiscard]] SampleFigures sample_figures(std::span<const double> values, std::uint64_t seed = 1);

/// What pairs (same world, same start) say about the difference of two planners.
struct PairedFigures {
  SampleFigures difference;  ///< of b − a
  /// Two-sided p of no difference; nothing for fewer than two pairs. p_wilcoxon is of Wilcoxon's
  /// signed ranks: zeros dropped, ties with mean ranks. p_permutation is of the sign-flip
  /// permutation test of the mean. Up to 20 pairs both are exact. Above, the first takes the normal
  /// approximation, the second 100 000 random flips.
  std::optional<double> p_wilcoxon;
  std::optional<double> p_permutation;
};

/// `a` and `b` are of the same length, pair by pair.
[[nodiscard]] PairedFigures paired_figures(std::span<const double> a, std::span<const double> b,
                                           std::uint64_t seed = 1);

}  // namespace canopeer
