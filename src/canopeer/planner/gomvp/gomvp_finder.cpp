#include "canopeer/planner/gomvp/gomvp_finder.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "canopeer/geometry/state_archive.h"
#include "canopeer/planner/gomvp/cbc_solver.h"
#include "canopeer/planner/gomvp/integer_program.h"
#include "canopeer/planner/gomvp/warm_start.h"
#include "canopeer/search/cell_union.h"
#include "canopeer/search/view_casts.h"

namespace canopeer {
namespace {

/// A search for all ways from a view takes as long as so many neighbour searches; both look at the
/// whole graph.
constexpr int kNeighborSearchesPerWays = 10;

/// When no view fits the time that is left: the one that shows most for its time.
InspectionPath best_single(const InspectionProblem& problem) {
  int best = 0;
  double highest = -1.0;
  for (int view = 0; view < problem.views(); ++view) {
    const double rate = path_weight(problem, {view}) /
                        std::max(problem.from_start_s[static_cast<std::size_t>(view)], 1e-6);
    if (rate <= highest) continue;
    highest = rate;
    best = view;
  }
  return {best};
}

}  // namespace

GomvpFinder::GomvpFinder(const GomvpOptions& options, InspectionProblem::Objective objective)
    : options_(options), objective_(objective) {}

void GomvpFinder::begin_segment() {
  targets_.clear();
  no_targets_ = false;
  fruitless_ = 0;
  last_cost_s_ = 0.0;
}

ViewPath GomvpFinder::find(const PathQuery& query, WorkMeter& work) {
  WorkMeter spent;
  targets_.clear();
  const auto targets = choose_targets(*query.targets, query.map->resolution_m(), options_);
  const auto worth = weights(targets);
  const GraphWays ways(*query.graph, query.at, options_.observe_s);
  spent.add(Work::neighbor_search, kNeighborSearchesPerWays);
  const auto views = choose_views(*query.graph, ways, *query.map, targets, worth, options_, spent);
  no_targets_ = targets.empty();
  fruitless_ = views.empty() ? fruitless_ + 1 : 0;

  ViewPath path;
  if (!views.empty()) {
    const auto program = problem(query, ways, views, worth, spent);
    std::vector<NodeId> nodes;
    std::set<int> shown;
    for (const int i : best_path(program, spent)) {
      const ChosenView& view = views[static_cast<std::size_t>(i)];
      nodes.push_back(view.node);
      shown.insert(view.targets.begin(), view.targets.end());
    }
    for (const int j : shown) targets_.push_back(targets[static_cast<std::size_t>(j)]);
    path = steps(query, nodes, spent);
  }
  last_cost_s_ = spent.seconds(*query.costs);
  work.merge(spent);
  return path;
}

std::vector<double> GomvpFinder::weights(const std::vector<CoverTarget>& targets) const {
  std::vector<double> weights;
  for (const CoverTarget& target : targets) {
    weights.push_back(target.kind == TargetKind::roi        ? options_.roi_weight
                      : target.kind == TargetKind::occupied ? options_.occupied_weight
                                                            : options_.border_weight);
  }
  return weights;
}

InspectionProblem GomvpFinder::problem(const PathQuery& query, const GraphWays& from_here,
                                       const std::vector<ChosenView>& views,
                                       const std::vector<double>& weights, WorkMeter& work) const {
  InspectionProblem problem;
  problem.objective = objective_;
  problem.budget_s = std::max(0.0, query.time_left_s - last_cost_s_);
  for (const ChosenView& view : views) {
    problem.from_start_s.push_back(from_here.time_s(view.node));
    const GraphWays ways(*query.graph, view.node, options_.observe_s);
    auto& row = problem.between_s.emplace_back();
    for (const ChosenView& to : views) row.push_back(ways.time_s(to.node));
  }
  work.add(Work::neighbor_search,
           static_cast<std::int64_t>(views.size()) * kNeighborSearchesPerWays);
  std::vector<std::vector<int>> seen_by(weights.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const int j : views[i].targets)
      seen_by[static_cast<std::size_t>(j)].push_back(static_cast<int>(i));
  }
  for (std::size_t j = 0; j < seen_by.size(); ++j) {
    if (seen_by[j].empty()) continue;  // no view sees it: not to be covered
    problem.seen_by.push_back(std::move(seen_by[j]));
    problem.weight.push_back(weights[j]);
  }
  return with_targets_merged(std::move(problem));
}

InspectionPath GomvpFinder::best_path(const InspectionProblem& problem, WorkMeter& work) const {
  InspectionPath known = greedy_path(problem);
  work.add(Work::expansion, problem.views() * static_cast<std::int64_t>(known.size() + 1));
  if (known.empty()) return best_single(problem);
  if (options_.max_iterations == 0) return known;
  const InspectionProgram program(problem, options_.neighbors, known);
  const SolverAnswer answer = solve(program.program(), program.values_of(known),
                                    {options_.max_nodes, options_.max_iterations});
  work.add(Work::simplex_row, answer.iterations * answer.rows);
  if (!answer.better) return known;
  InspectionPath better = program.path_of(*answer.better);
  // The solver computes with tolerances.
  return path_is_valid(problem, better) ? better : known;
}

ViewPath GomvpFinder::steps(const PathQuery& query, const std::vector<NodeId>& views,
                            WorkMeter& work) const {
  std::vector<NodeId> nodes;
  for (const NodeId view : views) {
    const NodeId from = nodes.empty() ? query.at : nodes.back();
    const auto way = GraphWays(*query.graph, from, options_.observe_s).way(view);
    nodes.insert(nodes.end(), way.begin(), way.end());
  }
  ensure_casts(*query.graph, nodes, *query.map, options_.fan, work);
  ViewPath path;
  CellUnion covered;
  double time_s = 0.0;
  std::int64_t unknown = 0;
  NodeId from = query.at;
  for (const NodeId node : nodes) {
    const VoxelSet& cells = query.graph->node(node).cast->unknown;
    const auto place = covered.prepare(cells);
    PathStep step{node, *query.graph->edge_time(from, node) + options_.observe_s,
                  covered.count_new(cells, place)};
    covered.add(cells, place);
    time_s += step.time_s;
    unknown += step.new_unknown;
    path.steps.push_back(step);
    from = node;
  }
  path.utility = time_s > 0.0 ? static_cast<double>(unknown) / time_s : 0.0;
  return path;
}

bool GomvpFinder::keeps(const PathQuery& query, WorkMeter& work) {
  work.add(Work::candidate, static_cast<std::int64_t>(targets_.size()));
  const auto seen = std::count_if(targets_.begin(), targets_.end(), [&](const CoverTarget& target) {
    return is_seen(*query.map, target);
  });
  return static_cast<double>(seen) < options_.replan_share * static_cast<double>(targets_.size());
}

bool GomvpFinder::done() const { return no_targets_ || fruitless_ >= options_.give_up_after; }

std::string GomvpFinder::state() const {
  return state_bytes(targets_, no_targets_, fruitless_, last_cost_s_);
}

Expected<void> GomvpFinder::restore(std::string_view state) {
  return read_state_bytes(state, targets_, no_targets_, fruitless_, last_cost_s_);
}

std::unique_ptr<Planner> make_gomvp(VmpOptions vmp, GomvpOptions options,
                                    InspectionProblem::Objective objective) {
  options.observe_s = vmp.path_search.observe_s;
  options.fan = vmp.path_search.fan;
  vmp.search = VmpOptions::Search::other;
  vmp.finder = [=] { return std::make_unique<GomvpFinder>(options, objective); };
  vmp.look_ahead_rad = std::numeric_limits<double>::infinity();
  vmp.replan_after_s = 0.0;
  return std::make_unique<VmpPlanner>(vmp);
}

}  // namespace canopeer
