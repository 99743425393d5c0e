#include "canopeer/bounds/limits/find_times.h"

#include <algorithm>
#include <limits>

namespace canopeer {
namespace {

struct Arrival {
  double time_s = 0.0;
  const PoolView* view = nullptr;
};

std::vector<Arrival> earliest_arrivals(const ViewPool& pool, const SegmentTimes& times,
                                       const MotionBound& motion) {
  std::vector<Arrival> arrivals;
  for (std::size_t s = 0; s < pool.segments.size(); ++s) {
    const std::vector<PoolView>& views = pool.segments[s];
    for (std::size_t v = 0; v < views.size(); ++v) {
      const double after_s = v == 0 ? 0.0 : times.look_s + motion.first(views[0].q, views[v].q);
      arrivals.push_back({times.earliest_s[s] + after_s, &views[v]});
    }
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.time_s < b.time_s; });
  return arrivals;
}

}  // namespace

std::vector<double> earliest_finds_s(const ViewPool& pool, const PoolFruits& fruits,
                                     const SegmentTimes& times, const MotionBound& motion) {
  const auto count = static_cast<std::size_t>(fruits.count);
  std::vector<double> found_s(count, std::numeric_limits<double>::infinity());
  std::vector<double> area_cm2(count, 0.0);
  std::vector<bool> seen(fruits.of_patch.size(), false);
  for (const Arrival& arrival : earliest_arrivals(pool, times, motion)) {
    for (const std::uint32_t patch : arrival.view->patches) {
      if (seen[patch]) continue;
      seen[patch] = true;
      const auto fruit = static_cast<std::size_t>(fruits.of_patch[patch]);
      area_cm2[fruit] += pool.patches.area_cm2[patch];
      if (area_cm2[fruit] >= fruits.enough_cm2) {
        found_s[fruit] = std::min(found_s[fruit], arrival.time_s);
      }
    }
  }
  return found_s;
}

}  // namespace canopeer
