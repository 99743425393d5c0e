#pragma once

#include "canopeer/bounds/tours/tour_beam.h"
#include "canopeer/bounds/tours/tour_local_search.h"

namespace canopeer {

struct TourSearchOptions {
  TourBeamOptions beam;
  TourLocalSearchOptions local;
  /// After a segment was planned anew: a look at what fits now.
  TourLocalSearchOptions quick{20, 3000};
  int rounds = 2;  ///< how often each segment is planned anew, given all the others
};

/// The best tour found:
/// 1. a greedy one, which takes the view that adds most by the second, and
/// 2. a beam search segment by segment in order (search_segment()); then each segment is planned
///    anew, given what the others find and when, as long as that makes the whole better; where the
///    clock never stops, with some guesses at what a second is worth to those behind;
/// 3. of the better one segments are cut short, where that leaves time to the next;
/// each improved by steps (improve_tour()). All its motions are free. The same problem gives the
/// same tour.
[[nodiscard]] Tour best_tour(const TourProblem& problem, const TourSearchOptions& options);

/// The greedy one alone.
[[nodiscard]] Tour greedy_tour(const TourProblem& problem);

}  // namespace canopeer
