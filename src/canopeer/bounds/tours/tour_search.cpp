#include "canopeer/bounds/tours/tour_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr double kGain = 1e-7;

void take_segment(const TourProblem& problem, std::size_t segment, const std::vector<int>& views,
                  TourState& state) {
  const auto taken = go_through(problem, static_cast<int>(segment), views, state);
  CANOPEER_CHECK(taken == views.size(), "searches give possible tours");
}

/// The view that adds most by the second; −1: none is left.
int greedy_view(const TourProblem& problem, int segment, const SegmentTime& time,
                const TourCoverage& seen, double t_s, int at) {
  const auto& views = problem.segments[static_cast<std::size_t>(segment)];
  while (true) {
    int best = -1;
    double most = kGain;
    for (std::size_t v = 1; v < views.size(); ++v) {
      const double motion_s = problem.motions->time_s(segment, at, static_cast<int>(v));
      if (!std::isfinite(motion_s) || !time.counts(t_s + motion_s)) continue;
      const double gain = seen.gain(views[v], problem.weight(t_s + motion_s), nullptr);
      const double rate = gain / (motion_s + problem.clock.observe_s + 1e-6);
      if (rate <= most) continue;
      most = rate;
      best = static_cast<int>(v);
    }
    if (best < 0 || problem.motions->free(segment, at, best)) return best;
  }
}

std::vector<int> greedy_segment(const TourProblem& problem, int segment, TourState state) {
  const SegmentTime time(problem, segment, state.t_s);
  std::vector<int> order;
  if (time.never_begins()) return order;
  const auto& views = problem.segments[static_cast<std::size_t>(segment)];
  state.seen.add(views.front());
  double t_s = time.after_home_s();
  int at = 0;
  while (time.may_set_out(t_s, 1 + static_cast<int>(order.size()))) {
    const int next = greedy_view(problem, segment, time, state.seen, t_s, at);
    if (next < 0) break;
    order.push_back(next);
    state.seen.add(views[static_cast<std::size_t>(next)]);
    t_s += problem.motions->time_s(segment, at, next) + problem.clock.observe_s;
    at = next;
  }
  return order;
}

/// What a second is worth that the next segment begins earlier: `factor` times the mission's mean
/// rate so far.
double worth_of_a_second(const TourState& state, double factor) {
  return state.t_s > 0.0 ? factor * state.score / state.t_s : 0.0;
}

/// Whether who leaves a segment earlier begins the next one earlier.
bool time_passes_on(const TourProblem& problem) {
  return !problem.clock.deadline_s.empty() || problem.clock.leave_when_done;
}

/// By that factor: a little, so that who is as good and earlier is better; where the clock never
/// stops, nobody knows beforehand what the next segment will make of a second.
std::vector<double> lateness_factors(const TourProblem& problem) {
  if (!time_passes_on(problem)) return {0.01};
  return {0.3, 1.0};
}

Tour tour_in_order(const TourProblem& problem, double factor, const TourBeamOptions& options) {
  Tour tour;
  TourState state{TourCoverage(problem)};
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    tour.push_back(search_segment(problem, static_cast<int>(s), state, nullptr,
                                  worth_of_a_second(state, factor), options));
    take_segment(problem, s, tour.back(), state);
  }
  return tour;
}

/// By fruit: the weight of when the segments after `segment` find it without this one's help.
std::vector<double> later_weights(const TourProblem& problem, const Tour& tour,
                                  std::size_t segment) {
  Tour without = tour;
  without[segment].clear();
  const TourOutcome outcome = outcome_of(problem, without);
  std::vector<double> weights(static_cast<std::size_t>(problem.fruits), 0.0);
  if (!outcome.possible) return weights;
  for (std::size_t f = 0; f < weights.size(); ++f) {
    if (std::isfinite(outcome.found_s[f])) weights[f] = problem.weight(outcome.found_s[f]);
  }
  return weights;
}

/// Each segment anew, given the others; later ones lose the views for which there is no time left.
Tour planned_anew(const TourProblem& problem, Tour tour, double factor,
                  const TourSearchOptions& options) {
  double best = outcome_of(problem, tour).score;
  TourState before{TourCoverage(problem)};
  for (std::size_t s = 0; s < tour.size(); ++s) {
    const std::vector<double> later = later_weights(problem, tour, s);
    Tour other = tour;
    other[s] = search_segment(problem, static_cast<int>(s), before, later.data(),
                              worth_of_a_second(before, factor), options.beam);
    if (other[s] != tour[s]) {
      other = improve_tour(problem, std::move(other), options.quick);
      const double score = outcome_of(problem, other).score;
      if (score > best + kGain) {
        const bool same_before =
            std::equal(tour.begin(), tour.begin() + static_cast<std::ptrdiff_t>(s), other.begin());
        best = score;
        tour = std::move(other);
        if (!same_before) return tour;
      }
    }
    take_segment(problem, s, tour[s], before);
  }
  return tour;
}

/// Each segment without its last view, the last two, or any, and the next one planned anew with the
/// time that this leaves.
Tour with_segments_cut(const TourProblem& problem, Tour tour, const TourSearchOptions& options) {
  double best = outcome_of(problem, tour).score;
  for (std::size_t s = 0; s + 1 < tour.size(); ++s) {
    std::vector<std::size_t> lengths;
    for (const std::size_t less : {std::size_t{1}, std::size_t{2}, tour[s].size()}) {
      if (less <= tour[s].size()) lengths.push_back(tour[s].size() - less);
    }
    for (const std::size_t length : lengths) {
      if (length >= tour[s].size()) continue;  // it is shorter by now
      Tour other = tour;
      other[s].resize(length);
      const std::vector<double> later = later_weights(problem, other, s + 1);
      TourState before{TourCoverage(problem)};
      for (std::size_t i = 0; i <= s; ++i) take_segment(problem, i, other[i], before);
      other[s + 1] = search_segment(problem, static_cast<int>(s) + 1, before, later.data(),
                                    worth_of_a_second(before, 0.5), options.beam);
      other = improve_tour(problem, std::move(other), options.quick);
      const double score = outcome_of(problem, other).score;
      if (score <= best + kGain) continue;
      best = score;
      tour = std::move(other);
    }
  }
  return tour;
}

}  // namespace

Tour greedy_tour(const TourProblem& problem) {
  Tour tour;
  TourState state{TourCoverage(problem)};
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    tour.push_back(greedy_segment(problem, static_cast<int>(s), state));
    take_segment(problem, s, tour.back(), state);
  }
  return tour;
}

Tour best_tour(const TourProblem& problem, const TourSearchOptions& options) {
  Tour best = improve_tour(problem, greedy_tour(problem), options.local);
  double most = outcome_of(problem, best).score;
  for (const double factor : lateness_factors(problem)) {
    Tour tour = improve_tour(problem, tour_in_order(problem, factor, options.beam), options.local);
    for (int round = 0; round < options.rounds; ++round) {
      tour = improve_tour(problem, planned_anew(problem, std::move(tour), factor, options),
                          options.local);
    }
    const double score = outcome_of(problem, tour).score;
    if (score <= most + kGain) continue;
    most = score;
    best = std::move(tour);
  }
  if (!time_passes_on(problem)) return best;
  return improve_tour(problem, with_segments_cut(problem, std::move(best), options), options.local);
}

}  // namespace canopeer
