#include "canopeer/scene/plants/statistics.h"

#include <algorithm>

namespace canopeer {

double value_at_rank(std::span<const Quantile> quantiles, double rank) {
  for (std::size_t i = 1; i < quantiles.size(); ++i) {
    const Quantile& a = quantiles[i - 1];
    const Quantile& b = quantiles[i];
    if (rank <= b.rank) {
      const double t = std::max(0.0, (rank - a.rank) / (b.rank - a.rank));
      return a.value + t * (b.value - a.value);
    }
  }
  return quantiles.back().value;
}

double clipped_normal(Rng& rng, double mean, double standard_deviation, double low, double high) {
  for (int i = 0; i < 64; ++i) {
    const double x = rng.normal(mean, standard_deviation);
    if (x >= low && x <= high) return x;
  }
  return std::clamp(mean, low, high);
}

}  // namespace canopeer
