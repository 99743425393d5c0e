#include "canopeer/report/sample_spread.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

double quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return 0.0;
  const double position = q * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(std::floor(position));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = position - static_cast<double>(below);
  return sorted[below] + share * (sorted[above] - sorted[below]);
}

SampleSpread sample_spread(std::vector<double> values) {
  SampleSpread spread;
  if (values.empty()) return spread;
  std::sort(values.begin(), values.end());
  spread.count = values.size();
  spread.lower_quartile = quantile(values, 0.25);
  spread.median = quantile(values, 0.5);
  spread.upper_quartile = quantile(values, 0.75);
  const double reach = 1.5 * (spread.upper_quartile - spread.lower_quartile);
  spread.lower_whisker = spread.lower_quartile;
  spread.upper_whisker = spread.upper_quartile;
  for (const double value : values) {
    if (value < spread.lower_quartile - reach || value > spread.upper_quartile + reach) {
      spread.outliers.push_back(value);
    } else {
      spread.lower_whisker = std::min(spread.lower_whisker, value);
      spread.upper_whisker = std::max(spread.upper_whisker, value);
    }
  }
  return spread;
}

}  // namespace canopeer
