#pragma once

#include <limits>
#include <vector>

namespace canopeer {

/// A path through views that sees targets: graph inspection planning. Views are numbered 0 … n − 1;
/// the path begins where the camera is and ends at any view. All times count standing still at the
/// view they lead to.
///
///   cover (Jose et al. 2025):   the shortest path that sees every target
///   orienteering:               the path of at most `budget_s` that sees most, by weight
struct InspectionProblem {
  enum class Objective { cover, orienteering };

  Objective objective = Objective::cover;
  std::vector<double> from_start_s;            ///< by view; finite, > 0
  std::vector<std::vector<double>> between_s;  ///< [from][to]; finite, symmetric, > 0
  std::vector<std::vector<int>> seen_by;       ///< S_j by target: views, ascending, not empty
  std::vector<double> weight;                  ///< by target, > 0
  double budget_s = std::numeric_limits<double>::infinity();  ///< orienteering only

  [[nodiscard]] int views() const { return static_cast<int>(from_start_s.size()); }
  [[nodiscard]] int targets() const { return static_cast<int>(seen_by.size()); }
  /// Of two paths that see as much the quicker one is better: what a second costs in weight, so
  /// little that no target is given up for it.
  [[nodiscard]] double price_of_time() const;
};

/// Views in the order of the path.
using InspectionPath = std::vector<int>;

[[nodiscard]] double path_time_s(const InspectionProblem& problem, const InspectionPath& path);
/// Σ weight of the targets that its views see.
[[nodiscard]] double path_weight(const InspectionProblem& problem, const InspectionPath& path);
/// No view twice; sees all targets (cover), keeps to the budget (orienteering).
[[nodiscard]] bool path_is_valid(const InspectionProblem& problem, const InspectionPath& path);
/// What is minimised, of a valid path: its time, or its time at the price less its weight.
[[nodiscard]] double path_cost(const InspectionProblem& problem, const InspectionPath& path);

/// The same problem with fewer targets: those seen by the same views become one. For cover those
/// go too that are seen wherever another one is seen.
[[nodiscard]] InspectionProblem with_targets_merged(InspectionProblem problem);

}  // namespace canopeer
