#include "canopeer/bounds/visibility_ceiling.h"

#include <algorithm>

namespace canopeer {

std::vector<double> seen_area_cm2(const FruitPatches& patches, const std::vector<char>& seen) {
  std::vector<double> area;
  for (std::size_t p = 0; p < patches.fruit.size(); ++p) {
    const auto fruit = static_cast<std::size_t>(patches.fruit[p]);
    if (fruit >= area.size()) area.resize(fruit + 1, 0.0);
    if (seen[p] != 0) area[fruit] += patches.area_cm2[p];
  }
  return area;
}

Ceiling ceiling_of(const ViewPool& pool, const FindRule& rule) {
  Ceiling ceiling;
  std::vector<char> seen(pool.patches.fruit.size(), 0);
  for (const auto& views : pool.segments) {
    for (const PoolView& view : views) {
      for (const std::uint32_t p : view.patches) seen[p] = 1;
    }
  }
  ceiling.views = pool.sampled;
  ceiling.area_cm2 = seen_area_cm2(pool.patches, seen);
  double area = 0.0;
  for (const double a : ceiling.area_cm2) {
    area += a;
    ceiling.fruits_seen += a > 0.0 ? 1 : 0;
    ceiling.fruits += a > 0.0 && a >= rule.min_area_cm2 ? 1 : 0;
  }
  if (pool.patches.area_total_cm2 > 0.0) ceiling.surface = area / pool.patches.area_total_cm2;
  const auto all = std::count(seen.begin(), seen.end(), char{1});
  const auto once = std::count(pool.times_seen.begin(), pool.times_seen.end(), 1U);
  if (all > 0) ceiling.seen_once = static_cast<double>(once) / static_cast<double>(all);
  return ceiling;
}

}  // namespace canopeer
