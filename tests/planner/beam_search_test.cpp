#include "canopeer/planner/nbs/beam_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "../search/small_graph.h"

namespace canopeer {
namespace {

constexpr NodeId kStart{0};
constexpr double kHorizonS = 4.0;

NbsOptions wide() {
  NbsOptions options;
  options.beam = 100000;
  options.max_expansions = 100000000;
  options.max_views = 5;
  options.promise = 0.0;
  return options;
}

ViewPath search(ViewGraph& graph, const NbsOptions& options, double horizon_s = kHorizonS) {
  PathSearchOptions views;
  views.observe_s = 0.1;
  const VoxelMap map;
  WorkMeter work;
  return search_beams(graph, kStart, map, views, options, horizon_s, work);
}

/// g, q and what comes next of a path, by their definitions, with sets of single voxels.
class ByDefinition {
 public:
  using Cells = std::set<std::tuple<int, int, int>>;

  ByDefinition(const ViewGraph& graph, const NbsOptions& options)
      : graph_(graph), options_(options) {}

  struct Next {
    NodeId node{};
    double time_s = 0.0;
    double added = 0.0;
    [[nodiscard]] double rate() const { return added / time_s; }
  };
  struct Path {
    std::vector<NodeId> nodes;
    double time_s = 0.0;
    double gain = 0.0;
  };

  [[nodiscard]] std::vector<Next> frontier(const Path& path) const {
    Cells seen;
    for (const NodeId id : path.nodes) add(id, seen);
    std::vector<Next> frontier;
    const NodeId at = path.nodes.empty() ? kStart : path.nodes.back();
    for (const ViewEdge& edge : graph_.node(at).edges) {
      const bool used = std::count(path.nodes.begin(), path.nodes.end(), edge.to) > 0;
      const double time_s = edge.time_s + 0.1;
      if (used || graph_.node(edge.to).visited || path.time_s + time_s > kHorizonS) continue;
      Cells more = seen;
      add(edge.to, more);
      frontier.push_back({edge.to, time_s, static_cast<double>(more.size() - seen.size())});
    }
    return frontier;
  }
  [[nodiscard]] Path step(const Path& path, const Next& next) const {
    Path longer = path;
    longer.nodes.push_back(next.node);
    longer.time_s += next.time_s;
    longer.gain += next.added * weight(longer);
    return longer;
  }
  [[nodiscard]] double expected(const Path& path, const std::vector<Next>& frontier,
                                std::optional<NodeId> but = std::nullopt) const {
    double rate = 0.0;
    for (const Next& next : frontier) {
      if (next.node != but) rate = std::max(rate, next.rate());
    }
    return path.gain + options_.promise * rate * (kHorizonS - path.time_s) *
                           (options_.early ? 0.5 * weight(path) : 1.0);
  }
  /// The highest q of any path from the start; of those of full length as it is before they are
  /// extended.
  [[nodiscard]] double best() const {
    double best = 0.0;
    const std::function<void(const Path&)> look = [&](const Path& path) {
      const auto next = frontier(path);
      if (!path.nodes.empty()) best = std::max(best, expected(path, next));
      for (const Next& view : next) {
        const Path longer = step(path, view);
        if (longer.nodes.size() == static_cast<std::size_t>(options_.max_views)) {
          best = std::max(best, expected(longer, next, view.node));
        } else {
          look(longer);
        }
      }
    };
    look({});
    return best;
  }
  /// Along the best rate, view by view.
  [[nodiscard]] Path greedy() const {
    Path path;
    while (path.nodes.size() < static_cast<std::size_t>(options_.max_views)) {
      const auto next = frontier(path);
      if (next.empty()) break;
      path =
          step(path, *std::max_element(next.begin(), next.end(), [](const Next& a, const Next& b) {
                 return a.rate() < b.rate();
               }));
    }
    return path;
  }
  [[nodiscard]] Path path(const ViewPath& found) const {
    Path path;
    for (const PathStep& step_found : found.steps) {
      const auto next = frontier(path);
      const auto it = std::find_if(next.begin(), next.end(),
                                   [&](const Next& view) { return view.node == step_found.node; });
      EXPECT_NE(it, next.end()) << "a path leads along edges to views not taken yet, in time";
      if (it == next.end()) break;
      EXPECT_EQ(static_cast<double>(step_found.new_unknown), it->added);
      EXPECT_NEAR(step_found.time_s, it->time_s, 1e-12);
      path = step(path, *it);
    }
    return path;
  }

 private:
  [[nodiscard]] double weight(const Path& path) const {
    return options_.early ? 1.0 - path.time_s / kHorizonS : 1.0;
  }
  void add(NodeId id, Cells& cells) const {
    graph_.node(id).cast->unknown.for_each(
        [&](const VoxelIndex& v) { cells.emplace(v.x(), v.y(), v.z()); });
  }

  const ViewGraph& graph_;
  const NbsOptions& options_;
};

TEST(BeamSearch, WithAWideBeamItFindsTheBestOfAllPaths) {
  Rng rng(11);
  for (int i = 0; i < 60; ++i) {
    ViewGraph graph = test::random_graph(rng, 9, 7);
    for (const bool early : {false, true}) {
      for (const double promise : {0.0, 0.5}) {
        NbsOptions options = wide();
        options.early = early;
        options.promise = promise;
        const ByDefinition definition(graph, options);
        const ViewPath found = search(graph, options);
        const auto path = definition.path(found);
        ASSERT_NEAR(found.utility, path.gain, 1e-9 * (1.0 + path.gain));
        const double best = definition.best();
        if (promise == 0.0) {
          ASSERT_NEAR(found.utility, best, 1e-9 * (1.0 + best));
        } else if (path.nodes.size() < static_cast<std::size_t>(options.max_views)) {
          ASSERT_NEAR(definition.expected(path, definition.frontier(path)), best,
                      1e-9 * (1.0 + best));
        }
      }
    }
  }
}

TEST(BeamSearch, WithABeamOfOneItIsNoWorseThanTheGreedyPath) {
  Rng rng(12);
  int better = 0;
  for (int i = 0; i < 200; ++i) {
    ViewGraph graph = test::random_graph(rng, 30, 40);
    NbsOptions options = wide();
    options.beam = 1;
    options.max_expansions = 20;
    const double greedy = ByDefinition(graph, options).greedy().gain;
    const double found = search(graph, options).utility;
    ASSERT_GE(found, greedy * (1.0 - 1e-12));
    better += found > greedy * (1.0 + 1e-9) ? 1 : 0;
  }
  EXPECT_GT(better, 50);
}

TEST(BeamSearch, WiderBeamsFindBetterPathsInTheMean) {
  Rng rng(13);
  double gain_of_1 = 0.0;
  double gain_of_8 = 0.0;
  double gain_of_all = 0.0;
  for (int i = 0; i < 60; ++i) {
    ViewGraph graph = test::random_graph(rng, 12, 12);
    NbsOptions options = wide();
    gain_of_all += search(graph, options).utility;
    options.beam = 8;
    gain_of_8 += search(graph, options).utility;
    options.beam = 1;
    gain_of_1 += search(graph, options).utility;
  }
  EXPECT_GT(gain_of_8, gain_of_1);
  EXPECT_GE(gain_of_8, 0.98 * gain_of_all);
}

TEST(BeamSearch, KeepsToItsLimits) {
  Rng rng(14);
  ViewGraph graph = test::random_graph(rng, 100, 200);
  for (std::size_t i = 0; i < graph.id_count(); ++i) {
    graph.node(static_cast<NodeId>(i)).cast.reset();
  }
  NbsOptions options;
  options.max_expansions = 1;
  options.max_views = 1;
  const VoxelMap map;
  WorkMeter work;
  const ViewPath path = search_beams(graph, kStart, map, {}, options, 100.0, work);
  EXPECT_LE(path.steps.size(), 1U);
  const auto neighbors = static_cast<std::int64_t>(graph.node(kStart).edges.size());
  EXPECT_EQ(work.units(Work::expansion), neighbors);
  EXPECT_EQ(work.units(Work::view_cast), neighbors);
}

TEST(BeamSearch, PassesVisitedViewsOverAndIsEmptyWhereNothingFits) {
  Rng rng(15);
  ViewGraph graph = test::random_graph(rng, 30, 40);
  for (int i = 0; i < 30; i += 2) graph.node(static_cast<NodeId>(i)).visited = true;
  for (const PathStep& step : search(graph, wide()).steps) {
    EXPECT_FALSE(graph.node(step.node).visited);
  }
  EXPECT_TRUE(search(graph, wide(), 0.2).steps.empty());
  EXPECT_TRUE(search(graph, wide(), 0.0).steps.empty());
}

}  // namespace
}  // namespace canopeer
