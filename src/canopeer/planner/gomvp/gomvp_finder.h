#pragma once

#include <memory>

#include "canopeer/planner/gomvp/chosen_views.h"
#include "canopeer/planner/gomvp/inspection_problem.h"
#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// GO-VMP: A. I. Jose, S. Pan, T. Zaenker, R. Menon, S. Houben, M. Bennewitz, "GO-VMP: Global
/// Optimization for View Motion Planning in Fruit Mapping", arXiv 2503.03912, 2025. Chooses
/// frontier targets and views of the graph, and finds by an integer program the quickest path
/// through views that see all targets (`cover`). The path is followed to its end, or until a share
/// of its targets is seen. A reconstruction: neither results nor code were available, and what the
/// paper's abstract names only (the targets' choice, the sparse graph, the limit of time) is ours.
/// `orienteering` is ours: the path within the segment's time left that sees most, by weight.
class GomvpFinder : public PathFinder {
 public:
  GomvpFinder(const GomvpOptions& options, InspectionProblem::Objective objective);

  void begin_segment() override;
  [[nodiscard]] ViewPath find(const PathQuery& query, WorkMeter& work) override;
  [[nodiscard]] bool keeps(const PathQuery& query, WorkMeter& work) override;
  [[nodiscard]] bool done() const override;
  [[nodiscard]] std::string state() const override;
  [[nodiscard]] Expected<void> restore(std::string_view state) override;

  /// What the last path was made to show.
  [[nodiscard]] const std::vector<CoverTarget>& targets() const { return targets_; }

 private:
  [[nodiscard]] std::vector<double> weights(const std::vector<CoverTarget>& targets) const;
  [[nodiscard]] InspectionProblem problem(const PathQuery& query, const GraphWays& from_here,
                                          const std::vector<ChosenView>& views,
                                          const std::vector<double>& weights,
                                          WorkMeter& work) const;
  [[nodiscard]] InspectionPath best_path(const InspectionProblem& problem, WorkMeter& work) const;
  [[nodiscard]] ViewPath steps(const PathQuery& query, const std::vector<NodeId>& views,
                               WorkMeter& work) const;

  GomvpOptions options_;
  InspectionProblem::Objective objective_;
  std::vector<CoverTarget> targets_;  ///< that the views of the last path see
  bool no_targets_ = false;           ///< at the last search
  int fruitless_ = 0;                 ///< searches in a row in which no view saw a target
  double last_cost_s_ = 0.0;          ///< of the last search, by the cost table
};

/// `vmp` with this search, and paths followed to their end.
[[nodiscard]] std::unique_ptr<Planner> make_gomvp(VmpOptions vmp, GomvpOptions options,
                                                  InspectionProblem::Objective objective);

}  // namespace canopeer
