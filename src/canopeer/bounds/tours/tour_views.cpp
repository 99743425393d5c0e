#include "canopeer/bounds/tours/tour_views.h"

#include <algorithm>
#include <numeric>

#include "canopeer/robot/straight_timing.h"

namespace canopeer {
namespace {

double worth_alone(const TourView& view, double enough_cm2) {
  double sum = 0.0;
  for (const FruitPart& part : view.parts) sum += std::min<double>(part.area_cm2, enough_cm2);
  return sum;
}

/// `other` shows as much of each fruit that `view` shows, as far as it counts.
bool shows_no_more(const TourView& view, const TourView& other, double enough_cm2) {
  auto theirs = other.parts.begin();
  for (const FruitPart& part : view.parts) {
    while (theirs != other.parts.end() && theirs->fruit < part.fruit) ++theirs;
    const bool there = theirs != other.parts.end() && theirs->fruit == part.fruit;
    if (!there || theirs->area_cm2 < std::min<double>(part.area_cm2, enough_cm2)) return false;
  }
  return true;
}

/// Indices into a segment's views, those that show most first, without dominated ones.
std::vector<std::size_t> undominated(const std::vector<PoolView>& pool,
                                     const std::vector<TourView>& views, const RobotModel& robot,
                                     double enough_cm2, const TourViewOptions& options) {
  std::vector<double> worth;
  for (const TourView& view : views) worth.push_back(worth_alone(view, enough_cm2));
  std::vector<std::size_t> order(views.size() - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return worth[a] > worth[b]; });
  std::vector<std::size_t> kept;
  for (const std::size_t v : order) {
    const bool dominated = std::any_of(kept.begin(), kept.end(), [&](std::size_t other) {
      const Configuration to = robot.endless().nearest(pool[other].q, pool[v].q);
      return shows_no_more(views[v], views[other], enough_cm2) &&
             motion_time(pool[v].q, to, robot.limits()) <= options.alike_s;
    });
    if (!dominated) kept.push_back(v);
  }
  return kept;
}

/// At most so many: the best of each fruit, then in the order given.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& order,
                                 const std::vector<TourView>& views,
                                 const TourViewOptions& options) {
  const auto most = static_cast<std::size_t>(std::max(0, options.per_segment - 1));
  if (order.size() <= most) return order;
  std::vector<std::vector<std::pair<float, std::size_t>>> of_fruit;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    for (const FruitPart& part : views[order[rank]].parts) {
      const auto fruit = static_cast<std::size_t>(part.fruit);
      if (fruit >= of_fruit.size()) of_fruit.resize(fruit + 1);
      of_fruit[fruit].emplace_back(-part.area_cm2, rank);
    }
  }
  std::vector<char> keep(order.size(), 0);
  std::size_t count = 0;
  const auto take = [&](std::size_t rank) {
    if (count == most || keep[rank] != 0) return;
    keep[rank] = 1;
    ++count;
  };
  for (auto& best : of_fruit) std::sort(best.begin(), best.end());
  for (int k = 0; k < options.per_fruit; ++k) {
    for (const auto& best : of_fruit) {
      if (static_cast<std::size_t>(k) < best.size()) take(best[static_cast<std::size_t>(k)].second);
    }
  }
  for (std::size_t rank = 0; rank < order.size(); ++rank) take(rank);
  std::vector<std::size_t> found;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    if (keep[rank] != 0) found.push_back(order[rank]);
  }
  return found;
}

}  // namespace

TourView make_tour_view(std::vector<std::uint32_t> patches, const std::vector<int>& fruit_of,
                        const std::vector<float>& area_cm2) {
  TourView view;
  view.patches = std::move(patches);
  std::sort(view.patches.begin(), view.patches.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(fruit_of[a], a) < std::pair(fruit_of[b], b);
  });
  for (std::uint32_t i = 0; i < view.patches.size(); ++i) {
    const std::uint32_t patch = view.patches[i];
    if (view.parts.empty() || view.parts.back().fruit != fruit_of[patch]) {
      view.parts.push_back({fruit_of[patch], 0.0F, i, i});
    }
    view.parts.back().area_cm2 += area_cm2[patch];
    view.parts.back().last = i + 1;
  }
  return view;
}

TourViews tour_views(const ViewPool& pool, const RobotModel& robot, double min_area_cm2,
                     const TourViewOptions& options) {
  // Fruits by rising id, without gaps.
  std::vector<int> ids = pool.patches.fruit;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<int> fruit_of;
  for (const int id : pool.patches.fruit) {
    fruit_of.push_back(
        static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()));
  }
  TourViews result;
  result.fruit_ids = ids;
  for (const std::vector<PoolView>& segment : pool.segments) {
    std::vector<TourView> views;
    for (const PoolView& view : segment) {
      views.push_back(make_tour_view(view.patches, fruit_of, pool.patches.area_cm2));
    }
    const double enough_cm2 = options.enough_factor * min_area_cm2;
    auto kept = thinned(undominated(segment, views, robot, enough_cm2, options), views, options);
    kept.insert(kept.begin(), 0);
    auto& chosen = result.segments.emplace_back();
    for (const std::size_t v : kept) chosen.push_back(std::move(views[v]));
    result.pool_index.push_back(std::move(kept));
  }
  return result;
}

}  // namespace canopeer
