#pragma once

#include <span>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// The published count pairs centres up to 0.20 m apart; the strict one up to 0.05 m.
inline constexpr double kPaperMatchDistanceM = 0.20;
inline constexpr double kStrictMatchDistanceM = 0.05;

/// An estimate and the true fruit it stands for, as indices into the given lists.
struct FruitPair {
  int estimate = 0;
  int truth = 0;
  double distance_m = 0.0;
};

/// Which estimates are which counted fruits. First the counted fruits are paired, as if the others
/// (green ones) were not there. Then each estimate left over that pairs with an uncounted fruit by
/// the same rule is `ignored`: neither detected nor a false positive.
struct FruitMatching {
  std::vector<FruitPair> pairs;  ///< counted fruits only, by ascending estimate
  int false_positives = 0;       ///< estimates neither paired nor ignored
  int ignored = 0;
};

/// One to one, always the closest pair left, up to max_distance_m (inclusive): how the paper
/// counts. Ties go to the lower estimate, then the lower truth.
[[nodiscard]] FruitMatching match_greedy(std::span<const Vec3> centres,
                                         std::span<const FruitTruth> truth,
                                         double max_distance_m = kPaperMatchDistanceM);

/// One to one: as many pairs up to max_distance_m (inclusive) as possible and, among those
/// assignments, the smallest sum of distances.
[[nodiscard]] FruitMatching match_optimal(std::span<const Vec3> centres,
                                          std::span<const FruitTruth> truth,
                                          double max_distance_m = kStrictMatchDistanceM);

}  // namespace canopeer
