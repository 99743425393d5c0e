#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/record/run_record.h"
#include "canopeer/record/summary.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// How many fruits were found when a frame had been taken in.
struct FoundAtTime {
  double t_s = 0.0;  ///< mission time
  int detected = 0;
  int detected_paper = 0;
};

/// The scores of one run, and its course.
struct RunMetrics : RunScores {
  std::vector<FoundAtTime> found;  ///< one entry per frame, by time
};

/// Scores a run: the counts from the final fruits, the course over time from the fruits known after
/// each view. `coverage`: of each true fruit the share of its surface that was seen (see
/// fruit_coverage()), empty: not known. Surface scores stay null; see surface_score().
[[nodiscard]] RunMetrics compute_metrics(const RunRecord& record,
                                         std::span<const FruitEstimate> fruits,
                                         std::span<const FruitTruth> truth,
                                         std::span<const double> coverage = {});

}  // namespace canopeer
