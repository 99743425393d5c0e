#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "canopeer/base/rng.h"
#include "canopeer/planner/gomvp/cbc_solver.h"
#include "canopeer/planner/gomvp/warm_start.h"

namespace canopeer {
namespace {

using Objective = InspectionProblem::Objective;

constexpr SolverLimits kNoLimit = {.max_nodes = 1000000, .max_iterations = 100000000};

/// Views at random places of the plane, targets seen by some of them.
InspectionProblem random_problem(Rng& rng, Objective objective, int views, int targets) {
  InspectionProblem problem;
  problem.objective = objective;
  std::vector<std::pair<double, double>> places;
  for (int i = 0; i <= views; ++i) places.push_back({rng.uniform(), rng.uniform()});
  const auto time_s = [&](std::size_t a, std::size_t b) {
    return 0.2 + std::hypot(places[a].first - places[b].first, places[a].second - places[b].second);
  };
  const auto n = static_cast<std::size_t>(views);
  problem.between_s.assign(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    problem.from_start_s.push_back(time_s(n, i));
    for (std::size_t j = 0; j < n; ++j) problem.between_s[i][j] = time_s(i, j);
  }
  for (int j = 0; j < targets; ++j) {
    std::vector<int> seen_by;
    for (int i = 0; i < views; ++i) {
      if (rng.chance(0.35)) seen_by.push_back(i);
    }
    if (seen_by.empty()) seen_by.push_back(static_cast<int>(rng.index(n)));
    problem.seen_by.push_back(seen_by);
    problem.weight.push_back(rng.chance(0.3) ? 4.0 : 1.0);
  }
  if (objective == Objective::orienteering) problem.budget_s = rng.uniform(0.2, 3.0);
  return problem;
}

/// The least cost of all valid paths, by trying every one.
double least_cost(const InspectionProblem& problem, InspectionPath& path) {
  double best = path_is_valid(problem, path) ? path_cost(problem, path)
                                             : std::numeric_limits<double>::infinity();
  for (int view = 0; view < problem.views(); ++view) {
    if (std::find(path.begin(), path.end(), view) != path.end()) continue;
    path.push_back(view);
    best = std::min(best, least_cost(problem, path));
    path.pop_back();
  }
  return best;
}

/// As the planner goes about it.
InspectionPath solved(const InspectionProblem& problem, int neighbors, const SolverLimits& limits,
                      SolverAnswer* answer = nullptr) {
  const InspectionPath known = greedy_path(problem);
  const InspectionProgram program(problem, neighbors, known);
  const SolverAnswer found = solve(program.program(), program.values_of(known), limits);
  if (answer != nullptr) *answer = found;
  return found.better ? program.path_of(*found.better) : known;
}

bool satisfies(const IntegerProgram& program, const std::vector<double>& values) {
  for (int r = 0; r < program.row_count(); ++r) {
    const auto row = static_cast<std::size_t>(r);
    double sum = 0.0;
    for (int k = program.starts[row]; k < program.starts[row + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      sum += program.values[entry] * values[static_cast<std::size_t>(program.columns[entry])];
    }
    if (sum < program.row_lower[row] - 1e-9 || sum > program.row_upper[row] + 1e-9) return false;
  }
  return true;
}

class InspectionProgramTest : public ::testing::TestWithParam<Objective> {};

TEST_P(InspectionProgramTest, FindsTheBestOfAllPathsOfTinyProblems) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed, "inspection");
    const int views = 2 + static_cast<int>(rng.index(6));
    const int targets = 1 + static_cast<int>(rng.index(10));
    const auto problem = random_problem(rng, GetParam(), views, targets);
    SolverAnswer answer;
    const InspectionPath path = solved(problem, views, kNoLimit, &answer);
    EXPECT_TRUE(answer.optimal) << "seed " << seed;
    ASSERT_TRUE(path_is_valid(problem, path)) << "seed " << seed;
    InspectionPath none;
    EXPECT_NEAR(path_cost(problem, path), least_cost(problem, none), 1e-5) << "seed " << seed;
  }
}

TEST_P(InspectionProgramTest, HasAsGoodAPathWithTargetsMerged) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed, "merged");
    const auto problem = random_problem(rng, GetParam(), 5, 12);
    const auto merged = with_targets_merged(problem);
    EXPECT_LE(merged.targets(), problem.targets());
    InspectionPath none;
    const InspectionPath path = solved(merged, 5, kNoLimit);
    ASSERT_TRUE(path_is_valid(problem, path)) << "seed " << seed;
    const double best = least_cost(problem, none);
    // Merged targets weigh more, so time has another price.
    const double slack = GetParam() == Objective::cover ? 1e-5 : 0.05;
    EXPECT_NEAR(path_cost(problem, path), best, slack) << "seed " << seed;
  }
}

TEST_P(InspectionProgramTest, BeginsWithAValidPathWhoseValuesSatisfyEveryRow) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed, "warm");
    const auto problem = random_problem(rng, GetParam(), 25, 60);
    const InspectionPath known = greedy_path(problem);
    ASSERT_TRUE(path_is_valid(problem, known)) << "seed " << seed;
    const InspectionProgram program(problem, 4, known);
    const auto values = program.values_of(known);
    EXPECT_TRUE(satisfies(program.program(), values)) << "seed " << seed;
    EXPECT_EQ(program.path_of(values), known);
    double cost = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) cost += program.program().cost[i] * values[i];
    EXPECT_NEAR(cost, path_cost(problem, known), 1e-9) << "seed " << seed;
  }
}

TEST_P(InspectionProgramTest, WithinLimitsIsNeverWorseThanItsStartAndAlwaysTheSame) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed, "limits");
    const auto problem = random_problem(rng, GetParam(), 15, 40);
    const SolverLimits limits = {.max_nodes = 5, .max_iterations = 500};
    SolverAnswer first;
    SolverAnswer second;
    const InspectionPath path = solved(problem, 5, limits, &first);
    EXPECT_TRUE(path_is_valid(problem, path));
    EXPECT_LE(path_cost(problem, path), path_cost(problem, greedy_path(problem)) + 1e-9);
    EXPECT_EQ(solved(problem, 5, limits, &second), path);
    EXPECT_EQ(first.iterations, second.iterations);
  }
}

INSTANTIATE_TEST_SUITE_P(Objectives, InspectionProgramTest,
                         ::testing::Values(Objective::cover, Objective::orienteering),
                         [](const auto& one) {
                           return one.param == Objective::cover ? "Cover" : "Orienteering";
                         });

TEST(GreedyPath, IsEmptyWhenNothingFitsTheBudget) {
  Rng rng(1, "nothing");
  auto problem = random_problem(rng, Objective::orienteering, 6, 8);
  problem.budget_s = 0.05;
  EXPECT_TRUE(greedy_path(problem).empty());
  EXPECT_TRUE(solved(problem, 5, kNoLimit).empty());
}

TEST(CbcSolver, PrintsNothing) {
  Rng rng(1, "silent");
  const auto problem = random_problem(rng, Objective::cover, 20, 30);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  solved(problem, 10, {.max_nodes = 50, .max_iterations = 5000});
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace canopeer
