#include "canopeer/fruit/fruit_ids.h"

#include <algorithm>
#include <tuple>

namespace canopeer {

void FruitIds::assign(std::vector<FruitEstimate>& found, const std::vector<FruitEstimate>& before,
                      double max_distance_m) {
  lost_.insert(lost_.end(), before.begin(), before.end());
  std::vector<std::tuple<double, int, int>> pairs;  // distance, found, lost
  for (std::size_t f = 0; f < found.size(); ++f) {
    found[f].id = -1;
    for (std::size_t l = 0; l < lost_.size(); ++l) {
      const double distance = (found[f].centre - lost_[l].centre).norm();
      if (distance <= max_distance_m) {
        pairs.emplace_back(distance, static_cast<int>(f), static_cast<int>(l));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<char> taken(lost_.size(), 0);
  for (const auto& [distance, f, l] : pairs) {
    if (found[f].id >= 0 || taken[l] != 0) continue;
    found[f].id = lost_[l].id;
    taken[l] = 1;
  }
  for (FruitEstimate& fruit : found) {
    if (fruit.id < 0) fruit.id = next_++;
  }
  std::vector<FruitEstimate> still_lost;
  for (std::size_t l = 0; l < lost_.size(); ++l) {
    if (taken[l] == 0) still_lost.push_back(lost_[l]);
  }
  lost_ = std::move(still_lost);
}

}  // namespace canopeer
