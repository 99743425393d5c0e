#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "canopeer/bounds/view_pool.h"

namespace canopeer {

/// What a view shows of one fruit: patches[first … last) of the view.
struct FruitPart {
  int fruit = 0;  ///< 0 … TourProblem::fruits − 1
  float area_cm2 = 0.0F;
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

/// What a view shows.
struct TourView {
  std::vector<std::uint32_t> patches;  ///< by fruit, ascending
  std::vector<FruitPart> parts;        ///< one a fruit, by fruit
};

/// Motions between the views of a segment; view 0 is that at home. Times and answers do not change,
/// except that a motion found not to be free takes for ever from then on.
class TourMotions {
 public:
  virtual ~TourMotions() = default;
  /// Straight from view to view, s; infinite: known not to be free.
  [[nodiscard]] virtual double time_s(int segment, int from, int to) = 0;
  /// Whether the motion touches nothing. May take long: asked of motions that are wanted.
  [[nodiscard]] virtual bool free(int segment, int from, int to) = 0;
  /// From a view to where the next segment begins, s: home, and the trolley's drive.
  [[nodiscard]] virtual double transition_s(int segment, int from) = 0;
};

/// How time passes, as SegmentRunner has it.
struct TourClock {
  /// By segment, after its begin, s: nobody sets out for a view any more; infinite: no limit.
  std::vector<double> budget_s;
  /// By segment, mission time, in place of budgets: the clock that never stops (mission_time.h).
  /// Nothing counts after the last. Empty: each segment has its own clock.
  std::vector<double> deadline_s;
  double observe_s = 0.0;  ///< what a view takes: latency of the camera, perception
  /// Of a segment that begins at `t_s`, in place of its deadline: where the row has one budget
  /// (shared_time_s()). Empty: it is not shared.
  std::function<double(int segment, double t_s)> shared_s{};
  std::vector<int> max_views;    ///< by segment, that at home included; 0: no limit
  bool leave_when_done = false;  ///< a segment ends with its last view
  double margin_s = 0.02;        ///< views are set out for so long before the time is up
};

/// Orienteering by segment: which views in which order, with what is seen shared by all.
struct TourProblem {
  std::vector<std::vector<TourView>> segments;  ///< view 0 is that at home
  std::vector<float> patch_cm2;
  int fruits = 0;
  int fruits_total = 0;                ///< counted ones: those without a patch too
  std::vector<double> min_area_cm2{};  ///< by fruit: seen so much of, it is found
  TourClock clock{};
  TourMotions* motions = nullptr;  ///< outlives whoever uses the problem

  /// What is wished for: weight of a find at mission time t is `early` · (1 − t/horizon_s) +
  /// `ever`.
  double ever = 1.0;
  double early = 0.0;
  double horizon_s = 1.0;
  [[nodiscard]] double weight(double t_s) const { return ever + early * (1.0 - t_s / horizon_s); }
};

/// Views by segment, without those at home.
using Tour = std::vector<std::vector<int>>;

}  // namespace canopeer
