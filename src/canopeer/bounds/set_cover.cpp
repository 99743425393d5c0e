#include "canopeer/bounds/set_cover.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

namespace canopeer {
namespace {

constexpr double kRounding = 1e-9;  // share of a sum of weights

/// A set and what it would have added when it was last looked at.
struct Promise {
  double gain = 0.0;
  std::size_t set = 0;
  friend bool operator<(const Promise& a, const Promise& b) {
    return a.gain != b.gain ? a.gain < b.gain : a.set > b.set;
  }
};

/// Calls take(set) for the best set again and again until it says no or nothing is gained.
/// `gain(set)` never grows.
template <typename Gain, typename Take>
void take_greedily(std::size_t sets, const Gain& gain, const Take& take) {
  std::priority_queue<Promise> queue;
  for (std::size_t s = 0; s < sets; ++s) queue.push({gain(s), s});
  while (!queue.empty()) {
    Promise best = queue.top();
    queue.pop();
    if (!(best.gain > 0.0)) return;
    const double now = gain(best.set);
    if (now < best.gain) {
      if (now > 0.0) queue.push({now, best.set});
    } else if (!take(best.set)) {
      return;
    }
  }
}

std::size_t elements_of(const CoverProblem& problem) { return problem.weight.size(); }

/// By element: how many sets have it.
std::vector<std::uint32_t> sets_by_element(const CoverProblem& problem) {
  std::vector<std::uint32_t> count(elements_of(problem), 0);
  for (const auto& set : problem.sets) {
    for (const std::uint32_t e : set) ++count[e];
  }
  return count;
}

/// Elements of which no two are in one set; those in the fewest sets first.
int disjoint_elements(const CoverProblem& problem, const std::vector<std::uint32_t>& count) {
  std::vector<std::vector<std::uint32_t>> sets_of(count.size());
  for (std::size_t s = 0; s < problem.sets.size(); ++s) {
    for (const std::uint32_t e : problem.sets[s]) {
      sets_of[e].push_back(static_cast<std::uint32_t>(s));
    }
  }
  std::vector<std::uint32_t> order(count.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return count[a] < count[b]; });
  std::vector<char> used(problem.sets.size(), 0);
  int found = 0;
  for (const std::uint32_t e : order) {
    if (sets_of[e].empty()) continue;
    const auto taken = [&](std::uint32_t s) { return used[s] != 0; };
    if (std::any_of(sets_of[e].begin(), sets_of[e].end(), taken)) continue;
    for (const std::uint32_t s : sets_of[e]) used[s] = 1;
    ++found;
  }
  return found;
}

/// The greedy prices made feasible.
int dual_fitting(const CoverProblem& problem) {
  std::vector<float> ones(elements_of(problem), 1.0F);
  const CoverProblem plain{problem.sets, ones};
  const Cover cover = greedy_cover(plain);
  std::vector<double> price(ones.size(), 0.0);
  double before = 0.0;
  std::vector<char> covered(ones.size(), 0);
  for (std::size_t k = 0; k < cover.sets.size(); ++k) {
    const double fresh = cover.covered[k] - before;
    before = cover.covered[k];
    for (const std::uint32_t e : problem.sets[cover.sets[k]]) {
      if (covered[e] == 0) price[e] = 1.0 / fresh;
      covered[e] = 1;
    }
  }
  double largest = 0.0;
  for (const auto& set : problem.sets) {
    double sum = 0.0;
    for (const std::uint32_t e : set) sum += price[e];
    largest = std::max(largest, sum);
  }
  if (!(largest > 0.0)) return 0;
  const double bound = std::accumulate(price.begin(), price.end(), 0.0) / largest;
  return static_cast<int>(std::ceil(bound - 1e-6));
}

CoverProblem problem_of(const ViewPool& pool, std::vector<PoolViewId>& ids) {
  CoverProblem problem;
  problem.weight = pool.patches.area_cm2;
  for (std::size_t s = 0; s < pool.segments.size(); ++s) {
    for (std::size_t v = 0; v < pool.segments[s].size(); ++v) {
      problem.sets.emplace_back(pool.segments[s][v].patches);
      ids.push_back({static_cast<int>(s), v});
    }
  }
  return problem;
}

/// Views until 90 % and all of the fruits that can be found are: greedy on the area that each fruit
/// still lacks.
std::pair<int, int> fruit_views(const FruitPatches& patches, const CoverProblem& problem,
                                const FindRule& rule) {
  const int fruits =
      patches.fruit.empty() ? 0 : *std::max_element(patches.fruit.begin(), patches.fruit.end()) + 1;
  std::vector<double> lacks(static_cast<std::size_t>(fruits), 0.0);
  const std::vector<std::uint32_t> count = sets_by_element(problem);
  for (std::size_t e = 0; e < count.size(); ++e) {
    if (count[e] > 0) lacks[static_cast<std::size_t>(patches.fruit[e])] += patches.area_cm2[e];
  }
  int findable = 0;
  for (double& lack : lacks) {
    const bool enough = lack >= rule.min_area_cm2;
    findable += enough ? 1 : 0;
    lack = enough ? rule.min_area_cm2 : 0.0;
  }
  std::vector<char> covered(patches.fruit.size(), 0);
  std::vector<double> adds(lacks.size(), 0.0);
  const auto gain = [&](std::size_t s) {
    double sum = 0.0;
    for (const std::uint32_t e : problem.sets[s]) {
      if (covered[e] == 0) adds[static_cast<std::size_t>(patches.fruit[e])] += patches.area_cm2[e];
    }
    for (const std::uint32_t e : problem.sets[s]) {
      const auto f = static_cast<std::size_t>(patches.fruit[e]);
      sum += std::min(adds[f], lacks[f]);
      adds[f] = 0.0;
    }
    return sum;
  };
  std::pair<int, int> views{0, 0};
  int found = 0;
  take_greedily(problem.sets.size(), gain, [&](std::size_t s) {
    ++views.second;
    for (const std::uint32_t e : problem.sets[s]) {
      double& lack = lacks[static_cast<std::size_t>(patches.fruit[e])];
      if (covered[e] != 0 || !(lack > 0.0)) continue;
      covered[e] = 1;
      lack -= patches.area_cm2[e];
      if (lack <= rule.min_area_cm2 * kRounding) {
        lack = 0.0;
        ++found;
      }
    }
    if (views.first == 0 && found >= 0.9 * findable) views.first = views.second;
    return found < findable;
  });
  return views;
}

}  // namespace

Cover greedy_cover(const CoverProblem& problem, double share) {
  Cover cover;
  const std::vector<std::uint32_t> count = sets_by_element(problem);
  for (std::size_t e = 0; e < count.size(); ++e) {
    if (count[e] > 0) cover.coverable += problem.weight[e];
  }
  std::vector<char> covered(count.size(), 0);
  double sum = 0.0;
  const double enough = share * cover.coverable * (1.0 - kRounding);
  if (!(enough > 0.0)) return cover;
  const auto gain = [&](std::size_t s) {
    double adds = 0.0;
    for (const std::uint32_t e : problem.sets[s]) {
      if (covered[e] == 0) adds += problem.weight[e];
    }
    return adds;
  };
  take_greedily(problem.sets.size(), gain, [&](std::size_t s) {
    sum += gain(s);
    for (const std::uint32_t e : problem.sets[s]) covered[e] = 1;
    cover.sets.push_back(s);
    cover.covered.push_back(sum);
    return share >= 1.0 || sum < enough;
  });
  return cover;
}

int cover_at_least(const CoverProblem& problem) {
  return std::max(disjoint_elements(problem, sets_by_element(problem)), dual_fitting(problem));
}

int share_cover_at_least(const CoverProblem& problem, double share) {
  const std::vector<std::uint32_t> count = sets_by_element(problem);
  double coverable = 0.0;
  for (std::size_t e = 0; e < count.size(); ++e) {
    if (count[e] > 0) coverable += problem.weight[e];
  }
  std::vector<double> weights;
  for (const auto& set : problem.sets) {
    double sum = 0.0;
    for (const std::uint32_t e : set) sum += problem.weight[e];
    weights.push_back(sum);
  }
  std::sort(weights.begin(), weights.end(), std::greater<>());
  double sum = 0.0;
  int sets = 0;
  while (sets < static_cast<int>(weights.size()) && sum < share * coverable * (1.0 - kRounding)) {
    sum += weights[static_cast<std::size_t>(sets++)];
  }
  return sets;
}

PoolCover cover_of(const ViewPool& pool, const FindRule& rule) {
  std::vector<PoolViewId> ids;
  const CoverProblem problem = problem_of(pool, ids);
  PoolCover cover;
  const Cover all = greedy_cover(problem);
  for (const std::size_t set : all.sets) cover.views.push_back(ids[set]);
  const auto most = std::find_if(all.covered.begin(), all.covered.end(),
                                 [&](double covered) { return covered >= 0.9 * all.coverable; });
  cover.views_90 = all.sets.empty() ? 0 : static_cast<int>(most - all.covered.begin()) + 1;
  cover.at_least_90 = share_cover_at_least(problem, 0.9);
  cover.at_least_100 = cover_at_least(problem);
  std::tie(cover.fruit_views_90, cover.fruit_views_100) = fruit_views(pool.patches, problem, rule);
  return cover;
}

}  // namespace canopeer
