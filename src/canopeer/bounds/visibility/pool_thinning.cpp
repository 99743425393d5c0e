#include "canopeer/bounds/visibility/pool_thinning.h"

#include <algorithm>
#include <numeric>

#include "canopeer/bounds/set_cover.h"

namespace canopeer {
namespace {

/// Largest first, so that whoever has another's patches comes before it.
std::vector<std::size_t> without_dominated(std::span<const PoolView> views,
                                           const EndlessJoints& endless, double near_rad) {
  std::vector<std::size_t> order(views.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return views[a].patches.size() > views[b].patches.size();
  });
  std::vector<std::size_t> kept;
  for (const std::size_t i : order) {
    const auto& patches = views[i].patches;
    const bool dominated =
        i != 0 && std::any_of(kept.begin(), kept.end(), [&](std::size_t k) {
          const auto& others = views[k].patches;
          return endless.distance(views[k].q, views[i].q) <= near_rad &&
                 std::includes(others.begin(), others.end(), patches.begin(), patches.end());
        });
    if (!dominated) kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

std::vector<std::size_t> views_to_keep(std::span<const PoolView> views, const FruitPatches& patches,
                                       const EndlessJoints& endless, double near_rad,
                                       std::size_t keep) {
  std::vector<std::size_t> left = without_dominated(views, endless, near_rad);
  if (left.size() <= keep) return left;
  std::vector<std::size_t> kept{0};
  for (bool first = true; (first || kept.size() < keep) && !left.empty(); first = false) {
    CoverProblem problem;
    problem.weight = patches.area_cm2;
    for (const std::size_t i : left) problem.sets.emplace_back(views[i].patches);
    const Cover cover = greedy_cover(problem);
    if (cover.sets.empty()) break;
    std::vector<char> taken(left.size(), 0);
    for (const std::size_t set : cover.sets) {
      if (!first && kept.size() >= keep) break;
      taken[set] = 1;
      if (left[set] != 0) kept.push_back(left[set]);
    }
    std::vector<std::size_t> rest;
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (taken[k] == 0) rest.push_back(left[k]);
    }
    left = std::move(rest);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace canopeer
