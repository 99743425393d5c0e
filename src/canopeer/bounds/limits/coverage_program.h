#pragma once

#include <vector>

#include "canopeer/bounds/limits/linear_program.h"
#include "canopeer/bounds/limits/segment_times.h"
#include "canopeer/bounds/limits/visit_columns.h"

namespace canopeer {

/// How many fruits a plan can have found at most at time `t_s` when it has begun segment `last` by
/// then, but none behind it. A linear program with, for each segment s up to `last`, its start a_s,
/// the columns x_j that are bought in it (cost c_j), and o_s, what its last motion goes on beyond
/// its deadline; and z_f for each fruit, which all segments share:
///   max Σ z_f
///   z_f ≤ Σ_j share_jf x_j, z_f ≤ 1; 0 where f cannot be found by t at all
///   a_s + Σ_j∈s c_j x_j + leave_s + drive_s ≤ a_s+1, with the look at home;  for `last`: … ≤ t
///   Σ_j∈s c_j x_j ≤ deadline − a_s + o_s, o_s ≤ the dearest motion
///   Σ_j∈s x_j ≤ max_views
/// `on_the_way`: frames are taken on ways home too, so deadlines stop nobody; nor do max_views.
class CoverageProgram {
 public:
  /// `segments` and `times` outlive it; one for each.
  CoverageProgram(const std::vector<SegmentColumns>& segments, const SegmentTimes& times,
                  int fruits, bool on_the_way)
      : segments_(segments), times_(times), fruits_(fruits), on_the_way_(on_the_way) {}

  /// `open`: by fruit, whether it can be found by then. Before earliest_s[last] there is no plan.
  [[nodiscard]] LinearProgram at(double t_s, std::size_t last, const std::vector<bool>& open) const;
  /// What columns of a segment can cost together by `t_s` at most, s.
  [[nodiscard]] double budget_s(std::size_t segment, double t_s) const;

 private:
  const std::vector<SegmentColumns>& segments_;
  const SegmentTimes& times_;
  int fruits_;
  bool on_the_way_;
};

}  // namespace canopeer
