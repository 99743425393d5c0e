#pragma once

#include <vector>

#include "canopeer/bounds/tours/tour_schedule.h"

namespace canopeer {

/// How wide a segment is searched. Counts, so that a plan is no matter of time.
struct TourBeamOptions {
  int width = 100;       ///< partial tours kept in each slice of time
  int slices = 40;       ///< of a segment's time; where there is no limit: of one view each
  int most_views = 40;   ///< of a segment
  int candidates = 250;  ///< of its views: those that add most
};

/// The best order of views found for one segment, from `state` on: partial tours that end at about
/// the same time compete with each other only, so that one that saw much and took long does not
/// drive out the quick ones (labels of a dynamic program over time, the best of each slice kept).
/// Two tours of the same views, or of the same worth with the same last view, count once each.
///
/// `later`: what others make of each fruit anyway, as a weight (TourProblem::weight); null:
/// nothing. `lateness`: what a second costs by which the next segment begins later.
[[nodiscard]] std::vector<int> search_segment(const TourProblem& problem, int segment,
                                              const TourState& state, const double* later,
                                              double lateness, const TourBeamOptions& options);

}  // namespace canopeer
