#include "canopeer/viewgraph/view_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "canopeer/base/rng.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

ViewPose view_at(const Configuration& q) {
  ViewPose view;
  view.q = q;
  return view;
}

Configuration random_q(Rng& rng) {
  Configuration q(6);
  for (int i = 0; i < 6; ++i) q[i] = rng.uniform(-1.0, 1.0);
  return q;
}

TEST(ViewGraph, EdgesGoBothWaysAndLeaveWithTheirNode) {
  ViewGraph graph;
  const NodeId a = graph.add(view_at(Configuration::Zero(6)));
  const NodeId b = graph.add(view_at(Configuration::Ones(6)));
  const NodeId c = graph.add(view_at(-Configuration::Ones(6)));
  graph.connect(a, b, 1.5);
  graph.connect(b, a, 1.5);
  graph.connect(b, c, 2.0);
  graph.connect(a, a, 1.0);
  EXPECT_EQ(graph.edge_count(), 2);
  EXPECT_EQ(graph.edge_time(b, a), 1.5);
  graph.remove(b);
  EXPECT_EQ(graph.edge_count(), 0);
  EXPECT_EQ(graph.node_count(), 2);
  EXPECT_TRUE(graph.node(a).edges.empty());
  EXPECT_FALSE(graph.edge_time(b, c).has_value());
}

TEST(ViewGraph, NearestAreThoseOfBruteForce) {
  Rng rng(1);
  ViewGraph graph;
  for (int i = 0; i < 300; ++i) graph.add(view_at(random_q(rng)));
  graph.remove(NodeId{17});
  graph.node(NodeId{18}).visited = true;
  for (int trial = 0; trial < 20; ++trial) {
    const Configuration q = random_q(rng);
    const auto found = graph.nearest(q, 5, 2.5, NodeId{3});
    std::vector<double> all;
    for (std::size_t i = 0; i < 300; ++i) {
      if (i == 17 || i == 3) continue;
      all.push_back(joint_distance(q, graph.node(static_cast<NodeId>(i)).view.q));
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(
        found.size(),
        std::min<std::size_t>(5, static_cast<std::size_t>(std::count_if(
                                     all.begin(), all.end(), [](double d) { return d <= 2.5; }))));
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].distance_rad, all[i]);
    for (const auto& neighbor : graph.nearest_unvisited(q, 300, 100.0, NodeId{3})) {
      EXPECT_NE(neighbor.id, NodeId{18});
    }
  }
}

TEST(ViewGraph, JointsThatTurnWithoutEndCountTheShorterWayRound) {
  JointLimits limits;
  limits.lower = Configuration::Constant(6, -7.0);
  limits.upper = Configuration::Constant(6, 7.0);
  limits.lower[2] = -std::numeric_limits<double>::infinity();
  limits.upper[2] = std::numeric_limits<double>::infinity();
  ViewGraph graph;
  graph.set_endless(EndlessJoints(limits));
  Configuration q = Configuration::Zero(6);
  q[2] = 3.0;
  const NodeId a = graph.add(view_at(q));
  q[2] = -3.0;
  const NodeId b = graph.add(view_at(q));
  EXPECT_NEAR(graph.distance_rad(a, b), 2.0 * std::numbers::pi - 6.0, 1e-12);
  q[2] = 3.1 + 8.0 * std::numbers::pi;
  const auto near = graph.nearest(q, 5, 0.3, a);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].id, b);
  EXPECT_NEAR(near[0].distance_rad, 2.0 * std::numbers::pi - 6.1, 1e-9);
  EXPECT_TRUE(graph.nearest(q, 5, 0.1, a).empty());
}

TEST(ViewGraph, SimilarMeansCloseAndLookingTheSameWay) {
  ViewGraph graph;
  ViewPose view = view_at(Configuration::Zero(6));
  view.T_world_camera = look_at(Vec3(0, 0, 1), Vec3(-1, 0, 1));
  graph.add(view);
  const SimilarityLimits limits{0.05, 0.2};
  ViewPose other = view;
  other.T_world_camera = look_at(Vec3(0.03, 0, 1), Vec3(-1, 0, 1), 1.0);  // roll is free
  EXPECT_TRUE(graph.has_similar(other, limits));
  other.T_world_camera = look_at(Vec3(0.06, 0, 1), Vec3(-1, 0, 1));
  EXPECT_FALSE(graph.has_similar(other, limits));
  other.T_world_camera = look_at(Vec3(0, 0, 1), Vec3(-1, 0.25, 1));
  EXPECT_FALSE(graph.has_similar(other, limits));
}

TEST(ViewGraph, ForgetsOnlyTheCastsThatAChangeTouches) {
  ViewGraph graph;
  const NodeId near = graph.add(view_at(Configuration::Zero(6)));
  const NodeId far = graph.add(view_at(Configuration::Ones(6)));
  const auto block = [](int x) { return pack_block(x, 2 * x, -x); };
  const auto blocks = [&](const std::vector<int>& xs) {
    std::vector<BlockKey> keys;
    for (const int x : xs) keys.push_back(block(x));
    return BlockSet(keys);
  };
  graph.node(near).cast = ViewCast{VoxelSet(), blocks({1, 5, 9})};
  graph.node(far).cast = ViewCast{VoxelSet(), blocks({2, 6})};
  graph.invalidate_casts({block(4), block(5)});
  EXPECT_FALSE(graph.node(near).cast.has_value());
  EXPECT_TRUE(graph.node(far).cast.has_value());
  EXPECT_EQ(graph.with_casts(), std::vector{far});
}

TEST(ViewGraph, ReadBackFromItsStateItIsTheSameGraph) {
  Rng rng(2);
  ViewGraph graph;
  for (int i = 0; i < 200; ++i) {
    ViewPose view = view_at(random_q(rng));
    view.T_world_camera.translation() = Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
    view.target_world = Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
    view.kind = static_cast<TargetKind>(rng.index(4));
    const NodeId id = graph.add(std::move(view));
    graph.node(id).visited = rng.chance(0.2);
    for (int k = 0; k < 3; ++k)
      graph.connect(id, static_cast<NodeId>(rng.index(graph.id_count())), rng.uniform());
    if (rng.chance(0.1)) graph.remove(static_cast<NodeId>(rng.index(graph.id_count())));
  }
  const std::string state = state_bytes(graph);
  ViewGraph again;
  again.add(view_at(random_q(rng)));  // goes
  ASSERT_TRUE(read_state_bytes(state, again).has_value());
  EXPECT_EQ(state_bytes(again), state);
  EXPECT_EQ(again.id_count(), graph.id_count());
  EXPECT_EQ(again.node_count(), graph.node_count());
  EXPECT_EQ(again.edge_count(), graph.edge_count());
  for (int i = 0; i < 50; ++i) {
    const Configuration q = random_q(rng);
    const auto found = graph.nearest_unvisited(q, 7, 3.0, NodeId{0});
    const auto found_again = again.nearest_unvisited(q, 7, 3.0, NodeId{0});
    ASSERT_EQ(found_again.size(), found.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found_again[k].id, found[k].id);
    ViewPose view = view_at(q);
    view.T_world_camera.translation() = Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
    const SimilarityLimits limits{.position_m = 0.1};
    EXPECT_EQ(again.has_similar(view, limits), graph.has_similar(view, limits));
  }
}

}  // namespace
}  // namespace canopeer
