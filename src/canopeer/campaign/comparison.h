#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/campaign/run_figures.h"
#include "canopeer/campaign/statistics.h"

namespace canopeer {

/// All runs of one contestant on one mission with one budget.
struct ContestantRuns {
  std::string label;
  std::vector<RunFigures> runs;        ///< by seed
  std::vector<SampleFigures> figures;  ///< parallel to figures(); runs without the figure left out
};

/// The first contestant against another, over the seeds both have.
struct PairedComparison {
  std::string label;                   ///< of the other
  std::vector<PairedFigures> figures;  ///< parallel to figures(): other − first
};

/// One mission by one set of rules: what is compared with each other.
struct Match {
  std::string mission;
  std::optional<double> budget_s;
  int fruits_total = 0;
  std::vector<ContestantRuns> contestants;  ///< in the plan's order; those without a run left out
  std::vector<PairedComparison> against_first;
  std::string protocol{};  ///< empty: the mission's own rules

  [[nodiscard]] std::string title() const;
  /// Some contestant has a value of that figure; others are no row of a table for people.
  [[nodiscard]] bool anybody_has(std::size_t figure) const;
};

/// The runs of a campaign, compared mission by mission.
struct Comparison {
  int runs_planned = 0;
  int runs_there = 0;
  std::vector<Match> matches;  ///< missions in the plan's order, budgets or protocols within
};

/// Sums up the runs that are there; some may be missing.
[[nodiscard]] Comparison compare(const CampaignPlan& plan, const std::vector<RunFigures>& runs);

}  // namespace canopeer
