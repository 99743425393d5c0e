#pragma once

#include <cstddef>
#include <vector>

#include "canopeer/bounds/tours/tour_problem.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// The views that tours are made of, and which of the pool's they are.
struct TourViews {
  std::vector<std::vector<TourView>> segments;
  std::vector<std::vector<std::size_t>> pool_index;  ///< by segment and view
  std::vector<int> fruit_ids;                        ///< by fruit: FruitTruth::id
};

/// Which of a pool's views are worth planning with.
struct TourViewOptions {
  int per_segment = 500;       ///< at most, that at home included
  int per_fruit = 12;          ///< of these, the best of each fruit come first
  double alike_s = 0.35;       ///< a motion as short as that lies between views that are alike
  double enough_factor = 4.0;  ///< more of a fruit than so many times the least area adds nothing
};

/// Of each segment: that at home first, always. Then views by what they show, without those that
/// show of no fruit more than another that is alike. Of what is left first the best of each fruit,
/// then those that show most.
[[nodiscard]] TourViews tour_views(const ViewPool& pool, const RobotModel& robot,
                                   double min_area_cm2, const TourViewOptions& options);

/// The parts of a view by fruit; `fruit_of` and `area_cm2` by patch.
[[nodiscard]] TourView make_tour_view(std::vector<std::uint32_t> patches,
                                      const std::vector<int>& fruit_of,
                                      const std::vector<float>& area_cm2);

}  // namespace canopeer
