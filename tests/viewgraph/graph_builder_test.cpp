#include "canopeer/viewgraph/graph_builder.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>

#include "canopeer/robot/straight_timing.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

struct Grown {
  ViewGraph graph;
  WorkMeter work;
};

Grown grow(const test::PlanningFixture& world, int batches, GraphBuilderOptions options = {}) {
  Grown grown;
  GraphBuilder builder(grown.graph, world.frame, world.robot, world.ik, options, 5);
  builder.set_targets(world.perception.map(), world.home.change.targets, {});
  const Pose T_world_camera =
      world.frame.T_world_base * world.robot.T_base_camera(world.frame.home);
  builder.add_start(world.frame.home, world.checker, T_world_camera, grown.work);
  for (int i = 0; i < batches && !builder.resting(); ++i) {
    builder.grow(world.perception.map(), world.checker, grown.work);
  }
  return grown;
}

TEST(GraphBuilder, EdgesAreShortFreeAndTakeTheirMotionTime) {
  const test::PlanningFixture world;
  const Grown grown = grow(world, 20);
  const GraphBuilderOptions options;
  EXPECT_GT(grown.graph.node_count(), 30);
  for (std::size_t i = 0; i < grown.graph.id_count(); ++i) {
    const ViewNode& node = grown.graph.node(static_cast<NodeId>(i));
    if (node.removed) continue;
    const bool start = node.view.kind == TargetKind::none;
    EXPECT_TRUE(start || !node.edges.empty());  // views no motion reaches are dropped
    for (const auto& edge : node.edges) {
      const ViewNode& other = grown.graph.node(edge.to);
      const bool to_start = start || other.view.kind == TargetKind::none;
      const double limit =
          to_start ? options.max_start_distance_rad : options.max_edge_distance_rad;
      EXPECT_LE(joint_distance(node.view.q, other.view.q), limit);
      EXPECT_EQ(edge.time_s, motion_time(node.view.q, other.view.q, world.robot.limits()));
      EXPECT_TRUE(world.checker.edge_free(node.view.q, other.view.q));
    }
  }
}

TEST(GraphBuilder, EdgesCostWhatSharpMotionsTake) {
  const test::PlanningFixture world;
  GraphBuilderOptions options;
  options.sharp = ImageMotionLimit{CameraIntrinsics(), 0.5, 100.0};
  const Grown grown = grow(world, 5, options);
  int slower = 0;
  for (std::size_t i = 0; i < grown.graph.id_count(); ++i) {
    const ViewNode& node = grown.graph.node(static_cast<NodeId>(i));
    if (node.removed) continue;
    for (const auto& edge : node.edges) {
      const Configuration& to = grown.graph.node(edge.to).view.q;
      const double sharp_s = straight_motion_time(node.view.q, to, world.robot, options.sharp);
      EXPECT_NEAR(edge.time_s, sharp_s, 1e-9);  // joined from either side
      if (edge.time_s > 1.1 * motion_time(node.view.q, to, world.robot.limits())) ++slower;
    }
  }
  EXPECT_GT(slower, 20);
}

TEST(GraphBuilder, NoTwoViewsAreSimilar) {
  const test::PlanningFixture world;
  const Grown grown = grow(world, 10);
  ViewGraph kept;
  for (std::size_t i = 0; i < grown.graph.id_count(); ++i) {
    const ViewNode& node = grown.graph.node(static_cast<NodeId>(i));
    if (node.removed || node.view.kind == TargetKind::none) continue;
    EXPECT_FALSE(kept.has_similar(node.view, GraphBuilderOptions{}.similarity));
    kept.add(node.view);
  }
}

TEST(GraphBuilder, TheGraphIsTheSameWithAnyNumberOfThreads) {
  const test::PlanningFixture world;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return grow(world, 6);
  };
  const Grown one = with_threads(1);
  const Grown two = with_threads(2);
  ASSERT_EQ(one.graph.id_count(), two.graph.id_count());
  ASSERT_EQ(one.graph.edge_count(), two.graph.edge_count());
  for (std::size_t i = 0; i < one.graph.id_count(); ++i) {
    EXPECT_EQ(one.graph.node(static_cast<NodeId>(i)).view.q,
              two.graph.node(static_cast<NodeId>(i)).view.q);
  }
  EXPECT_EQ(one.work.units(Work::state_check), two.work.units(Work::state_check));
}

TEST(GraphBuilder, NoKindTakesMoreThanItsShare) {
  const test::PlanningFixture world;
  GraphBuilderOptions options;
  options.max_nodes = 200;
  options.batch = 8;
  const Grown grown = grow(world, 400, options);
  const auto most = [&](double share) { return share * options.max_nodes + options.batch; };
  EXPECT_LE(grown.graph.open_views(TargetKind::occupied), most(options.shares.occupied));
  EXPECT_LE(grown.graph.open_views(TargetKind::border), most(options.shares.border));
  EXPECT_GE(grown.graph.open_views(TargetKind::border), options.shares.border * options.max_nodes);
}

TEST(GraphBuilder, RestsWhenFullAndMakesRoomWhenTargetsChange) {
  const test::PlanningFixture world;
  GraphBuilderOptions options;
  options.max_nodes = 40;
  ViewGraph graph;
  WorkMeter work;
  GraphBuilder builder(graph, world.frame, world.robot, world.ik, options, 5);
  EXPECT_TRUE(builder.resting());  // nothing to look at yet
  builder.set_targets(world.perception.map(), world.home.change.targets, {});
  while (!builder.resting()) builder.grow(world.perception.map(), world.checker, work);
  EXPECT_GE(graph.node_count(), options.max_nodes);
  // On an empty map nothing is known, so every target still borders on the unknown: all views stay.
  const int full = graph.node_count();
  builder.set_targets(VoxelMap(), world.home.change.targets, {});
  EXPECT_EQ(graph.node_count(), full);
  // Where all is known, no target is left but those of the views kept for the path.
  VoxelMap known;
  std::vector<BlockUpdate> updates;
  for (const auto& voxels : {world.home.change.targets.roi, world.home.change.targets.occupied,
                             world.home.change.targets.border}) {
    for (const auto& v : voxels) {
      for (int dz = -8; dz <= 8; dz += 8) {
        for (int dy = -8; dy <= 8; dy += 8) {
          for (int dx = -8; dx <= 8; dx += 8) {
            BlockUpdate update;
            update.key = block_key(v + VoxelIndex(dx, dy, dz));
            update.miss = VoxelMask::all();
            updates.push_back(update);
          }
        }
      }
    }
  }
  const auto by_key = [](const BlockUpdate& a, const BlockUpdate& b) { return a.key < b.key; };
  const auto same_key = [](const BlockUpdate& a, const BlockUpdate& b) { return a.key == b.key; };
  std::sort(updates.begin(), updates.end(), by_key);
  updates.erase(std::unique(updates.begin(), updates.end(), same_key), updates.end());
  known.apply(updates);
  NodeId kept{0};
  while (graph.node(kept).removed) kept = static_cast<NodeId>(static_cast<std::uint32_t>(kept) + 1);
  builder.set_targets(known, world.home.change.targets, {kept});
  EXPECT_EQ(graph.node_count(), 1);
  EXPECT_FALSE(graph.node(kept).removed);
}

}  // namespace
}  // namespace canopeer
