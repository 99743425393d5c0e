#include "canopeer/bounds/limits/marginals.h"

#include <algorithm>
#include <numeric>

namespace canopeer {
namespace {

/// What is still missing of each fruit, 0 … 1; 0 where it cannot be found.
using Missing = std::vector<double>;

double gain_of(const VisitColumn& column, const Missing& missing) {
  double gain = 0.0;
  for (const auto& [f, share] : column.shares) {
    gain += std::min<double>(share, missing[static_cast<std::size_t>(f)]);
  }
  return gain;
}

void take(const VisitColumn& column, Missing& missing) {
  for (const auto& [f, share] : column.shares) {
    double& left = missing[static_cast<std::size_t>(f)];
    left = std::max(0.0, left - static_cast<double>(share));
  }
}

void add_greedily(const SegmentColumns& segment, double budget_s, Missing& missing) {
  std::vector<double> gains(segment.columns.size());  // upper bounds: they only fall
  for (std::size_t j = 0; j < gains.size(); ++j) gains[j] = gain_of(segment.columns[j], missing);
  while (true) {
    const VisitColumn* best = nullptr;
    double best_rate = 0.0;
    for (std::size_t j = 0; j < gains.size(); ++j) {
      const VisitColumn& column = segment.columns[j];
      if (column.cost_s > budget_s || gains[j] <= best_rate * column.cost_s) continue;
      gains[j] = gain_of(column, missing);
      if (gains[j] <= best_rate * column.cost_s) continue;
      best = &column;
      best_rate = gains[j] / std::max(column.cost_s, 1e-9);
    }
    if (best == nullptr) return;
    take(*best, missing);
    budget_s -= best->cost_s;
  }
}

/// Σ of gains, by gain per cost, the last in part.
double fractional_knapsack(const SegmentColumns& segment, double budget_s, const Missing& missing) {
  struct Item {
    double gain, cost_s, copies;
  };
  std::vector<Item> items;
  for (const VisitColumn& column : segment.columns) {
    const double gain = gain_of(column, missing);
    if (gain > 0.0) items.push_back({gain, column.cost_s, column.copies});
  }
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return a.gain * b.cost_s > b.gain * a.cost_s;
  });
  double sum = 0.0;
  for (const Item& item : items) {
    const double cost_s = item.cost_s * item.copies;
    if (cost_s >= budget_s) return sum + item.gain * item.copies * budget_s / cost_s;
    sum += item.gain * item.copies;
    budget_s -= cost_s;
  }
  return sum;
}

}  // namespace

double Marginals::bound(std::span<const double> budgets_s, const std::vector<bool>& open) const {
  Missing missing(static_cast<std::size_t>(fruits_), 0.0);
  for (std::size_t f = 0; f < missing.size(); ++f) missing[f] = open[f] ? 1.0 : 0.0;
  const double all = std::accumulate(missing.begin(), missing.end(), 0.0);
  const std::size_t count = std::min(budgets_s.size(), segments_.size());
  for (std::size_t s = 0; s < count; ++s) {
    const std::vector<float>& home = segments_[s].home.share;
    for (std::size_t f = 0; f < missing.size(); ++f) {
      missing[f] = std::max(0.0, missing[f] - static_cast<double>(home[f]));
    }
  }
  for (std::size_t s = 0; s < count; ++s) add_greedily(segments_[s], budgets_s[s], missing);
  double bound = all - std::accumulate(missing.begin(), missing.end(), 0.0);
  for (std::size_t s = 0; s < count; ++s) {
    bound += fractional_knapsack(segments_[s], budgets_s[s], missing);
  }
  return std::min(bound, all);
}

}  // namespace canopeer
