#pragma once

#include <cstdint>

#include "canopeer/bounds/tours/tour_schedule.h"

namespace canopeer {

struct TourLocalSearchOptions {
  int candidates = 60;  ///< views of a segment tried in its tour: those that add most to the rest
  std::int64_t max_trials = 400000;  ///< tours reckoned
};

/// Makes a tour better as long as one of these steps does, segment by segment: a view put
/// in, taken out or in the place of another, a stretch turned round (2-opt), a stretch of up to
/// three views put elsewhere (or-opt). Of each segment's steps the best is taken whose motions are
/// free. What later segments make of it is reckoned: they may lose what was seen before them, and
/// views for which there is no time left. What is not possible of `tour` is left out.
[[nodiscard]] Tour improve_tour(const TourProblem& problem, Tour tour,
                                const TourLocalSearchOptions& options);

}  // namespace canopeer
