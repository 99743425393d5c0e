#include "canopeer/planner/gomvp/inspection_problem.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace canopeer {
namespace {

std::vector<bool> seen_targets(const InspectionProblem& problem, const InspectionPath& path) {
  std::vector<bool> seen(problem.seen_by.size(), false);
  for (std::size_t j = 0; j < seen.size(); ++j) {
    const auto& views = problem.seen_by[j];
    seen[j] = std::any_of(path.begin(), path.end(), [&](int view) {
      return std::binary_search(views.begin(), views.end(), view);
    });
  }
  return seen;
}

}  // namespace

double InspectionProblem::price_of_time() const {
  const double all_s = std::accumulate(from_start_s.begin(), from_start_s.end(), 0.0);
  const double span_s = std::min(budget_s, all_s);
  if (weight.empty() || span_s <= 0.0) return 0.0;
  return 0.01 * *std::min_element(weight.begin(), weight.end()) / span_s;
}

double path_time_s(const InspectionProblem& problem, const InspectionPath& path) {
  double time_s = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto to = static_cast<std::size_t>(path[i]);
    time_s += i == 0 ? problem.from_start_s[to]
                     : problem.between_s[static_cast<std::size_t>(path[i - 1])][to];
  }
  return time_s;
}

double path_weight(const InspectionProblem& problem, const InspectionPath& path) {
  const auto seen = seen_targets(problem, path);
  double sum = 0.0;
  for (std::size_t j = 0; j < seen.size(); ++j) sum += seen[j] ? problem.weight[j] : 0.0;
  return sum;
}

bool path_is_valid(const InspectionProblem& problem, const InspectionPath& path) {
  InspectionPath sorted = path;
  std::sort(sorted.begin(), sorted.end());
  const bool once = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  const bool known = sorted.empty() || (sorted.front() >= 0 && sorted.back() < problem.views());
  if (!once || !known) return false;
  if (problem.objective == InspectionProblem::Objective::orienteering) {
    return path_time_s(problem, path) <= problem.budget_s + 1e-6;  // the solver's tolerance
  }
  const auto seen = seen_targets(problem, path);
  return std::all_of(seen.begin(), seen.end(), [](bool one) { return one; });
}

double path_cost(const InspectionProblem& problem, const InspectionPath& path) {
  const double time_s = path_time_s(problem, path);
  if (problem.objective == InspectionProblem::Objective::cover) return time_s;
  return problem.price_of_time() * time_s - path_weight(problem, path);
}

InspectionProblem with_targets_merged(InspectionProblem problem) {
  std::map<std::vector<int>, double> weight_by_views;
  for (std::size_t j = 0; j < problem.seen_by.size(); ++j)
    weight_by_views[problem.seen_by[j]] += problem.weight[j];
  std::vector<std::pair<std::vector<int>, double>> merged(weight_by_views.begin(),
                                                          weight_by_views.end());
  const auto fewer = [](const auto& a, const auto& b) { return a.first.size() < b.first.size(); };
  std::stable_sort(merged.begin(), merged.end(), fewer);
  problem.seen_by.clear();
  problem.weight.clear();
  for (auto& [views, weight] : merged) {
    const bool follows =
        problem.objective == InspectionProblem::Objective::cover &&
        std::any_of(problem.seen_by.begin(), problem.seen_by.end(), [&](const auto& kept) {
          return std::includes(views.begin(), views.end(), kept.begin(), kept.end());
        });
    if (follows) continue;
    problem.seen_by.push_back(std::move(views));
    problem.weight.push_back(weight);
  }
  return problem;
}

}  // namespace canopeer
