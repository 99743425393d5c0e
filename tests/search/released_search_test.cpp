#include "canopeer/search/released_search.h"

#include <gtest/gtest.h>

#include "small_graph.h"

namespace canopeer {
namespace {

/// A map in which nothing is known, and views side by side one radian apart, so that what a view
/// sees is the fan's cells where it stands.
ViewGraph views_in_a_row(int count) {
  ViewGraph graph;
  for (int i = 0; i < count; ++i) {
    ViewPose view;
    view.q = Configuration::Constant(6, 0.0);
    view.q[0] = i;
    view.kind = i == 0 ? TargetKind::none : TargetKind::occupied;
    view.T_world_camera = look_at(Vec3(0, 0.2 * i, 0), Vec3(1, 0.2 * i, 0));
    const NodeId id = graph.add(std::move(view));
    if (i == 0) graph.node(id).visited = true;
    if (i > 0) graph.connect(id, static_cast<NodeId>(i - 1), 1.0);
  }
  return graph;
}

TEST(ReleasedSearch, GoesForTheHighestWeightedGainWhateverTheWayCosts) {
  // Alike views, far apart in cells: |C| grows with t and (ROI + 1)/(t + 1) falls more slowly, so
  // the published goal is the farthest view, as far as the limit lets it look.
  ViewGraph graph = views_in_a_row(6);
  const VoxelMap map;
  WorkMeter work;
  const ViewPath path = search_released(graph, NodeId{0}, map, {}, CostTable{}, work);
  ASSERT_EQ(path.steps.size(), 5U);
  std::int64_t cells = 0;
  for (const auto& step : path.steps) cells += step.new_unknown;
  EXPECT_NEAR(path.utility, static_cast<double>(cells) / 6.0, 1e-9);
}

TEST(ReleasedSearch, StopsWhenItsTimeIsUp) {
  ViewGraph graph = views_in_a_row(8);
  const VoxelMap map;
  CostTable costs;
  costs[Work::expansion] = 1.0;
  WorkMeter work;
  // Nodes are expanded until more than 2 s are spent: after the third.
  const ViewPath path = search_released(graph, NodeId{0}, map, {}, costs, work);
  EXPECT_EQ(path.steps.size(), 3U);
  EXPECT_EQ(work.units(Work::expansion), 3);
}

TEST(ReleasedSearch, CastsEveryViewAnewInEverySearch) {
  ViewGraph graph = views_in_a_row(4);
  const VoxelMap map;
  for (int i = 0; i < 2; ++i) {
    WorkMeter work;
    static_cast<void>(search_released(graph, NodeId{0}, map, {}, CostTable{}, work));
    EXPECT_EQ(work.units(Work::view_cast), 3);
  }
}

TEST(ReleasedSearch, ReachesANodeByTheLeastAccumulatedJointDistanceFirst) {
  // 0 – 1 – 2 by small steps and 0 – 2 directly but farther: 2 is reached from 0 first, since a
  // node is reached when its first neighbour is expanded.
  ViewGraph graph = views_in_a_row(3);
  graph.connect(NodeId{0}, NodeId{2}, 1.0);
  const VoxelMap map;
  WorkMeter work;
  const ViewPath path = search_released(graph, NodeId{0}, map, {}, CostTable{}, work);
  for (const auto& step : path.steps) EXPECT_EQ(graph.edge_time(NodeId{0}, step.node), 1.0);
  EXPECT_EQ(path.steps.size(), 1U);
}

}  // namespace
}  // namespace canopeer
