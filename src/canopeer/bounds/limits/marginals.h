#pragma once

#include <span>
#include <vector>

#include "canopeer/bounds/limits/visit_columns.h"

namespace canopeer {

/// The bound that a plan A proves for all plans of the same budgets: shares found are submodular,
/// so no plan O finds more than F(A) + Σ of what each of its views would add to A, and that is a
/// knapsack in each segment (Leskovec et al. 2007; Breuer & Balkanski, arXiv 2008.05391). F counts
/// shares, min(1, Σ): never less than the fruits found.
class Marginals {
 public:
  /// `segments`: with home. They outlive it.
  Marginals(std::span<const SegmentColumns> segments, int fruits)
      : segments_(segments), fruits_(fruits) {}

  /// A: columns by the most that they add per cost, as long as each segment's budget lasts.
  /// `budgets_s`: a segment each; with fewer than there are, those behind are not begun. `open`:
  /// as in CoverageProgram.
  [[nodiscard]] double bound(std::span<const double> budgets_s,
                             const std::vector<bool>& open) const;

 private:
  std::span<const SegmentColumns> segments_;
  int fruits_;
};

}  // namespace canopeer
