#pragma once

#include <span>
#include <vector>

#include "canopeer/bounds/tours/tour_coverage.h"
#include "canopeer/bounds/tours/tour_problem.h"

namespace canopeer {

/// Where a mission is between two segments.
struct TourState {
  TourCoverage seen;
  double t_s = 0.0;    ///< the arm is home, the trolley stands
  double score = 0.0;  ///< Σ worth found · TourProblem::weight(when)
};

/// The clock of one segment that begins at `start_s`.
class SegmentTime {
 public:
  SegmentTime(const TourProblem& problem, int segment, double start_s);

  /// The mission is over before it begins.
  [[nodiscard]] bool never_begins() const { return over(start_s_); }
  [[nodiscard]] double after_home_s() const { return start_s_ + clock_->observe_s; }
  /// Who has taken so many views, that at home included, may set out at `t_s` for one more.
  [[nodiscard]] bool may_set_out(double t_s, int views) const;
  /// What is seen at `t_s` counts.
  [[nodiscard]] bool counts(double t_s) const { return !over(t_s + clock_->margin_s); }
  /// When the segment ends whose last view was done with at `t_s`.
  [[nodiscard]] double end_s(double t_s, int views) const;
  /// When nobody sets out any more; infinite: no limit.
  [[nodiscard]] double time_up_s() const { return time_up_s_; }

 private:
  [[nodiscard]] bool over(double t_s) const {
    return !clock_->deadline_s.empty() && t_s >= clock_->deadline_s.back();
  }

  const TourClock* clock_;
  int max_views_;
  double start_s_;
  double time_up_s_;
};

/// Goes through the segment: home, then `views` in order, as far as that is possible: until a
/// motion that is not free, or a view that nobody would set out for, or that would not count.
/// Returns how many views were taken. `times_s`: when, that at home first; may be null.
[[nodiscard]] std::size_t go_through(const TourProblem& problem, int segment,
                                     std::span<const int> views, TourState& state,
                                     std::vector<double>* times_s = nullptr);

/// What a whole tour comes to.
struct TourOutcome {
  bool possible = false;
  double score = 0.0;
  int found = 0;                             ///< fruits
  double auc = 0.0;                          ///< mean of found / fruits_total until the end
  double end_s = 0.0;                        ///< of the mission
  std::vector<std::vector<double>> times_s;  ///< by segment and view, that at home first
  std::vector<double> found_s;               ///< by fruit: when; infinite: never
};
[[nodiscard]] TourOutcome outcome_of(const TourProblem& problem, const Tour& tour);

}  // namespace canopeer
