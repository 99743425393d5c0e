#include "canopeer/search/random_walk.h"

#include <gtest/gtest.h>

#include <set>

#include "small_graph.h"

namespace canopeer {
namespace {

TEST(RandomWalk, GoesAlongEdgesToUnvisitedViewsWithoutReturning) {
  Rng rng(8);
  for (int i = 0; i < 100; ++i) {
    ViewGraph graph = test::random_graph(rng, 20, 20);
    graph.node(NodeId{3}).visited = true;
    const ViewPath path = random_walk(graph, NodeId{0}, 5, rng);
    std::set<NodeId> used = {NodeId{0}};
    NodeId at{0};
    for (const auto& step : path.steps) {
      ASSERT_EQ(graph.edge_time(at, step.node), step.time_s);
      ASSERT_TRUE(used.insert(step.node).second);
      ASSERT_NE(step.node, NodeId{3});
      at = step.node;
    }
  }
}

TEST(RandomWalk, DependsOnTheStreamOnly) {
  Rng make(9);
  const ViewGraph graph = test::random_graph(make, 50, 60);
  Rng a(1, "walk", 0);
  Rng b(1, "walk", 0);
  const ViewPath first = random_walk(graph, NodeId{0}, 6, a);
  const ViewPath second = random_walk(graph, NodeId{0}, 6, b);
  ASSERT_EQ(first.steps.size(), second.steps.size());
  for (std::size_t i = 0; i < first.steps.size(); ++i) {
    EXPECT_EQ(first.steps[i].node, second.steps[i].node);
  }
}

}  // namespace
}  // namespace canopeer
