#include "canopeer/search/path_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "small_graph.h"

namespace canopeer {
namespace {

using test::random_graph;
using test::utility_by_definition;

constexpr NodeId kStart{0};

PathSearchOptions exhaustive(bool reparent = false) {
  PathSearchOptions options;
  options.max_expansions = 1000000;
  options.max_views = 1000;
  options.observe_s = 0.0;
  options.reparent = reparent;
  return options;
}

std::vector<NodeId> nodes_of(const ViewPath& path) {
  std::vector<NodeId> nodes;
  for (const auto& step : path.steps) nodes.push_back(step.node);
  return nodes;
}

ViewPath search(ViewGraph& graph, const PathSearchOptions& options) {
  const VoxelMap map;
  WorkMeter work;
  return search_path(graph, kStart, map, options, work);
}

/// The highest utility of any simple path from the start.
double best_of_all(const ViewGraph& graph) {
  double best = 0.0;
  std::vector<NodeId> path;
  std::set<NodeId> used = {kStart};
  const std::function<void(NodeId)> extend = [&](NodeId at) {
    best = std::max(best, utility_by_definition(graph, kStart, path));
    for (const auto& edge : graph.node(at).edges) {
      if (graph.node(edge.to).visited || !used.insert(edge.to).second) continue;
      path.push_back(edge.to);
      extend(edge.to);
      path.pop_back();
      used.erase(edge.to);
    }
  };
  extend(kStart);
  return best;
}

TEST(SearchPath, UtilityIsEquationOneAlongThePathFound) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    ViewGraph graph = random_graph(rng, 30, 30);
    for (const bool reparent : {false, true}) {
      const ViewPath path = search(graph, exhaustive(reparent));
      ASSERT_FALSE(path.steps.empty());
      ASSERT_NEAR(path.utility, utility_by_definition(graph, kStart, nodes_of(path)),
                  1e-9 * path.utility);
    }
  }
}

TEST(SearchPath, NewUnknownOfTheStepsSumsToTheUnion) {
  Rng rng(2);
  ViewGraph graph = random_graph(rng, 40, 10);
  const ViewPath path = search(graph, exhaustive());
  VoxelSet all;
  std::int64_t sum = 0;
  for (const auto& step : path.steps) {
    all.merge(graph.node(step.node).cast->unknown);
    sum += step.new_unknown;
  }
  EXPECT_EQ(sum, all.count());
}

TEST(SearchPath, IsOptimalWhereEveryNodeHasOnePath) {
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    ViewGraph tree = random_graph(rng, 14, 0);
    EXPECT_NEAR(search(tree, exhaustive()).utility, best_of_all(tree), 1e-9);
  }
}

TEST(SearchPath, IsNeverBetterThanTheBestPathAndOftenAsGood) {
  Rng rng(4);
  int as_good = 0;
  double share = 0.0;
  constexpr int kGraphs = 200;
  for (int i = 0; i < kGraphs; ++i) {
    ViewGraph graph = random_graph(rng, 9, 6);
    const double found = search(graph, exhaustive()).utility;
    const double best = best_of_all(graph);
    ASSERT_LE(found, best * (1.0 + 1e-9));
    as_good += found > best * (1.0 - 1e-9) ? 1 : 0;
    share += found / best / kGraphs;
  }
  // The gap of the greedy rule (a node keeps its first predecessor) on these graphs.
  EXPECT_GT(as_good, kGraphs / 2);
  EXPECT_GT(share, 0.9);
}

TEST(SearchPath, ReparentingKeepsThePathSimple) {
  Rng rng(5);
  for (int i = 0; i < 100; ++i) {
    ViewGraph graph = random_graph(rng, 25, 60);
    const auto nodes = nodes_of(search(graph, exhaustive(true)));
    const std::set<NodeId> distinct(nodes.begin(), nodes.end());
    ASSERT_EQ(distinct.size(), nodes.size());
    ASSERT_FALSE(distinct.contains(kStart));
  }
}

TEST(SearchPath, PassesVisitedViewsOver) {
  Rng rng(6);
  ViewGraph graph = random_graph(rng, 30, 40);
  for (int i = 0; i < 30; i += 2) graph.node(static_cast<NodeId>(i)).visited = true;
  for (const NodeId id : nodes_of(search(graph, exhaustive()))) {
    EXPECT_FALSE(graph.node(id).visited);
  }
}

TEST(SearchPath, IsEmptyWhenNothingCanBeReached) {
  ViewGraph graph;
  test::add_view(graph, TargetKind::none, {});
  test::add_view(graph, TargetKind::roi, {VoxelIndex(0, 0, 0)});
  EXPECT_TRUE(search(graph, exhaustive()).steps.empty());
}

TEST(SearchPath, KeepsToTheLimitOfExpansions) {
  Rng rng(7);
  ViewGraph graph = random_graph(rng, 200, 200);
  for (std::size_t i = 0; i < graph.id_count(); ++i)
    graph.node(static_cast<NodeId>(i)).cast.reset();
  PathSearchOptions options;
  options.max_expansions = 1;
  const VoxelMap map;
  WorkMeter work;
  static_cast<void>(search_path(graph, kStart, map, options, work));
  EXPECT_EQ(work.units(Work::expansion),
            static_cast<std::int64_t>(graph.node(kStart).edges.size()));
  EXPECT_EQ(work.units(Work::view_cast), work.units(Work::expansion));  // only what it needed
}

}  // namespace
}  // namespace canopeer
