#pragma once

#include <vector>

#include "canopeer/fruit/fruit_estimate.h"

namespace canopeer {

/// Gives out ids 0, 1, 2, … such that a fruit found again keeps its own.
class FruitIds {
 public:
  /// Sets the ids of `found`: closest first, each takes the id of a previous fruit (`before`, or
  /// one that got lost earlier) within max_distance_m; the rest get new ones in the given order.
  void assign(std::vector<FruitEstimate>& found, const std::vector<FruitEstimate>& before,
              double max_distance_m);

 private:
  std::vector<FruitEstimate> lost_;
  int next_ = 0;
};

}  // namespace canopeer
