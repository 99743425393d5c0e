#pragma once

#include <optional>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// What a reported fruit turned out to be.
enum class Verdict {
  unscored,  ///< there is no ground truth
  found,     ///< pairs with a true fruit within 0.05 m
  near,      ///< pairs with one within 0.20 m only, as the paper counts
  green,     ///< is a fruit that does not count
  wrong      ///< no fruit there
};

struct FruitVerdict {
  Verdict verdict = Verdict::unscored;
  std::optional<std::size_t> truth;  ///< index of its fruit, for `found` and `near`
  double distance_m = 0.0;           ///< between the centres, when `truth` is there
};

/// One per estimate; `truth` empty: all unscored.
[[nodiscard]] std::vector<FruitVerdict> fruit_verdicts(const std::vector<FruitEstimate>& fruits,
                                                       const std::vector<FruitTruth>& truth);

}  // namespace canopeer
