#pragma once

#include <vector>

namespace canopeer {

/// What a box plot shows of a sample. Whiskers reach the farthest value within 1.5 times the
/// interquartile range of the box (Tukey 1977); the values beyond are outliers.
struct SampleSpread {
  std::size_t count = 0;
  double lower_whisker = 0.0;
  double lower_quartile = 0.0;
  double median = 0.0;
  double upper_quartile = 0.0;
  double upper_whisker = 0.0;
  std::vector<double> outliers;  ///< ascending
};

/// The q-quantile, q in [0, 1], linear between order statistics; 0 for an empty sample.
/// `sorted` is ascending.
[[nodiscard]] double quantile(const std::vector<double>& sorted, double q);

/// All zero for an empty sample.
[[nodiscard]] SampleSpread sample_spread(std::vector<double> values);

}  // namespace canopeer
