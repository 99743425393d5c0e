#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "canopeer/bounds/view_pool.h"

namespace canopeer {

/// Which elements each set has (ascending), and what each element weighs (≥ 0).
struct CoverProblem {
  std::vector<std::span<const std::uint32_t>> sets;
  std::span<const float> weight;  ///< by element
};

/// Sets in the order in which they were taken.
struct Cover {
  std::vector<std::size_t> sets;
  std::vector<double> covered;  ///< weight covered after each
  double coverable = 0.0;       ///< weight of all elements that are in a set
};

/// Always the set that adds the most weight next (the first of equals), until `share` (0 … 1) of
/// what can be covered is: Johnson 1974, Chvátal 1979. No more than ln n + 1 times as many sets as
/// the fewest. Marginal weights are looked up lazily (Minoux 1978).
[[nodiscard]] Cover greedy_cover(const CoverProblem& problem, double share = 1.0);

/// No choice of fewer sets has every element that is in a set. The larger of two bounds: elements
/// of which no two are in one set, picked greedily; and the greedy prices (1 / elements new in the
/// set that first took the element), divided by the largest sum of a set, which makes them feasible
/// for the dual of the linear program (Chvátal 1979).
[[nodiscard]] int cover_at_least(const CoverProblem& problem);
/// The same for `share` of the weight: fewer sets do not weigh as much together.
[[nodiscard]] int share_cover_at_least(const CoverProblem& problem, double share);

/// A view of a pool.
struct PoolViewId {
  int segment = 0;
  std::size_t view = 0;
};

/// How few views show what can be seen at all.
struct PoolCover {
  std::vector<PoolViewId> views;  ///< all patches, in the order of the greedy cover
  int views_90 = 0;               ///< 90 % of the coverable area
  int at_least_90 = 0;
  int at_least_100 = 0;
  /// So much of every fruit that can be found that it is (FindRule): 90 % of such fruits, all.
  int fruit_views_90 = 0;
  int fruit_views_100 = 0;
};
[[nodiscard]] PoolCover cover_of(const ViewPool& pool, const FindRule& rule);

}  // namespace canopeer
