#include "canopeer/bounds/tours/tour_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace canopeer {
namespace {

constexpr double kNotFound = std::numeric_limits<double>::infinity();

}  // namespace

SegmentTime::SegmentTime(const TourProblem& problem, int segment, double start_s)
    : clock_(&problem.clock), start_s_(start_s) {
  const auto index = static_cast<std::size_t>(segment);
  max_views_ = index < clock_->max_views.size() ? clock_->max_views[index] : 0;
  if (clock_->shared_s) {
    time_up_s_ = start_s + clock_->shared_s(segment, start_s);
  } else if (!clock_->deadline_s.empty()) {
    time_up_s_ = clock_->deadline_s[index];
  } else {
    time_up_s_ = start_s + clock_->budget_s[index];
  }
}

bool SegmentTime::may_set_out(double t_s, int views) const {
  if (max_views_ > 0 && views >= max_views_) return false;
  return t_s < time_up_s_ - clock_->margin_s;
}

double SegmentTime::end_s(double t_s, int views) const {
  const bool full = max_views_ > 0 && views >= max_views_;
  if (full || clock_->leave_when_done || !std::isfinite(time_up_s_)) return t_s;
  return std::max(t_s, time_up_s_);
}

std::size_t go_through(const TourProblem& problem, int segment, std::span<const int> views,
                       TourState& state, std::vector<double>* times_s) {
  const SegmentTime time(problem, segment, state.t_s);
  if (times_s != nullptr) times_s->clear();
  if (time.never_begins()) return 0;
  const auto& all = problem.segments[static_cast<std::size_t>(segment)];
  if (times_s != nullptr) times_s->push_back(state.t_s);
  state.score += problem.weight(state.t_s) * state.seen.add(all.front());
  double t_s = time.after_home_s();
  int at = 0;
  std::size_t taken = 0;
  for (const int view : views) {
    if (!time.may_set_out(t_s, static_cast<int>(taken) + 1)) break;
    const double there_s = t_s + problem.motions->time_s(segment, at, view);
    if (!std::isfinite(there_s) || !time.counts(there_s)) break;
    if (times_s != nullptr) times_s->push_back(there_s);
    state.score += problem.weight(there_s) * state.seen.add(all[static_cast<std::size_t>(view)]);
    t_s = there_s + problem.clock.observe_s;
    at = view;
    ++taken;
  }
  state.t_s =
      time.end_s(t_s, static_cast<int>(taken) + 1) + problem.motions->transition_s(segment, at);
  return taken;
}

TourOutcome outcome_of(const TourProblem& problem, const Tour& tour) {
  TourOutcome outcome;
  outcome.possible = true;
  outcome.times_s.resize(tour.size());
  outcome.found_s.assign(static_cast<std::size_t>(problem.fruits), kNotFound);
  TourState state{TourCoverage(problem)};
  TourCoverage seen(problem);
  for (std::size_t s = 0; s < tour.size(); ++s) {
    const auto taken =
        go_through(problem, static_cast<int>(s), tour[s], state, &outcome.times_s[s]);
    if (taken < tour[s].size()) {
      outcome.possible = false;
      return outcome;
    }
    for (std::size_t v = 0; v < outcome.times_s[s].size(); ++v) {
      const auto view = static_cast<std::size_t>(v == 0 ? 0 : tour[s][v - 1]);
      const TourView& shown = problem.segments[s][view];
      seen.add(shown);
      for (const FruitPart& part : shown.parts) {
        double& when = outcome.found_s[static_cast<std::size_t>(part.fruit)];
        if (seen.found(part.fruit)) when = std::min(when, outcome.times_s[s][v]);
      }
    }
  }
  outcome.score = state.score;
  outcome.end_s = problem.clock.deadline_s.empty() ? state.t_s : problem.clock.deadline_s.back();
  double sum_s = 0.0;
  for (const double when : outcome.found_s) {
    if (!std::isfinite(when)) continue;
    ++outcome.found;
    sum_s += std::max(0.0, outcome.end_s - when);
  }
  const double all_s = outcome.end_s * problem.fruits_total;
  outcome.auc = all_s > 0.0 ? sum_s / all_s : 0.0;
  return outcome;
}

}  // namespace canopeer
