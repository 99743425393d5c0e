#include "canopeer/planner/vmp/vmp_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "canopeer/robot/straight_timing.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

/// A planner with a grown graph in a segment that has just begun.
class VmpPlannerTest : public ::testing::Test {
 protected:
  void begin(const VmpOptions& options, const std::optional<ImageMotionLimit>& sharp = {}) {
    planner_ = std::make_unique<VmpPlanner>(options);
    PlanningScene scene;
    scene.robot = &world_.robot;
    scene.ik = &world_.ik;
    scene.map = &world_.perception.map();
    scene.checker = &world_.checker;
    scene.judge = &world_.simulation.judge().checker();
    scene.costs = &costs_;
    scene.segment = world_.frame;
    scene.sharp = sharp;
    planner_->begin_segment(scene);
    planner_->map_changed(world_.home.change);
  }

  void SetUp() override {
    costs_[Work::candidate] = 1e-4;
    VmpOptions options;
    options.look_ahead_rad = 100.0;
    begin(options);
    planner_->grow(0.2, work_);
  }

  /// Occupied voxels in a ball, in map and distance field, and the planner is told.
  void block_around(const Vec3& centre, double radius_m) {
    std::map<BlockKey, BlockUpdate> updates;
    const int r = static_cast<int>(radius_m / 0.01);
    const VoxelIndex c = voxel_at(centre, 0.01);
    for (int x = -r; x <= r; ++x) {
      for (int y = -r; y <= r; ++y) {
        for (int z = -r; z <= r; ++z) {
          if (x * x + y * y + z * z > r * r) continue;
          const VoxelIndex v = c + VoxelIndex(x, y, z);
          updates[block_key(v)].hit.set(v);
        }
      }
    }
    MapChange change;
    std::vector<BlockUpdate> list;
    for (auto& [key, update] : updates) {
      update.key = key;
      list.push_back(update);
      change.blocks.push_back(key);
    }
    // A few times, so that what was free before is occupied after.
    auto& map = const_cast<VoxelMap&>(world_.perception.map());
    auto& field = const_cast<DistanceField&>(world_.perception.field());
    for (int i = 0; i < 6; ++i) map.apply(list);
    field.update(map, change.blocks);
    change.targets = extract_frontiers(map, world_.frame.sampling_region_world);
    planner_->map_changed(std::move(change));
  }

  /// Goes along the plan until the next view's camera is well away from where the arm is; returns
  /// where that is.
  Configuration go_on_until_next_is_far() {
    Configuration q = world_.frame.home;
    for (int i = 0; i < 30; ++i) {
      q = planner_->decide(q, work_).motion.waypoints.back();
      if (planner_->path().empty()) continue;
      const Vec3 next = (world_.frame.T_world_base * world_.robot.T_base_camera(q)).inverse() *
                        camera_at(next_q());
      if (next.norm() > 0.1 && next.z() > -0.01) return q;
    }
    ADD_FAILURE() << "no long edge in 30 motions";
    return q;
  }
  [[nodiscard]] Configuration next_q() const {
    return planner_->graph().node(planner_->path().front()).view.q;
  }

  [[nodiscard]] Vec3 camera_at(const Configuration& q) const {
    return (world_.frame.T_world_base * world_.robot.T_base_camera(q)).translation();
  }

  test::PlanningFixture world_;
  CostTable costs_;
  WorkMeter work_;
  std::unique_ptr<VmpPlanner> planner_;
};

TEST_F(VmpPlannerTest, ItsEdgesCostWhatSharpMotionsTake) {
  const ImageMotionLimit sharp{CameraIntrinsics(), 0.5, 100.0};
  begin({}, sharp);
  planner_->grow(0.1, work_);
  planner_->decide(world_.frame.home, work_);
  int edges = 0;
  const ViewGraph& graph = planner_->graph();
  for (std::size_t i = 0; i < graph.id_count(); ++i) {
    const ViewNode& node = graph.node(static_cast<NodeId>(i));
    for (const ViewEdge& edge : node.edges) {
      const Configuration& to = graph.node(edge.to).view.q;
      EXPECT_NEAR(edge.time_s, straight_motion_time(node.view.q, to, world_.robot, sharp), 1e-9);
      ++edges;
    }
  }
  EXPECT_GT(edges, 20);
}

TEST_F(VmpPlannerTest, WaitsUntilThereIsAGraphThenMovesFromHome) {
  begin({});
  EXPECT_EQ(planner_->decide(world_.frame.home, work_).action, Decision::Action::wait);
  planner_->grow(0.2, work_);
  const Decision decision = planner_->decide(world_.frame.home, work_);
  ASSERT_EQ(decision.action, Decision::Action::move);
  EXPECT_EQ(decision.motion.waypoints.front(), world_.frame.home);
  EXPECT_GT(decision.motion.predicted_gain.value(), 0);
  EXPECT_TRUE(world_.checker.edge_free(decision.motion.waypoints.front(),
                                       decision.motion.waypoints.back()));
}

TEST_F(VmpPlannerTest, SketchShowsItsGraphAndItsPath) {
  EXPECT_FALSE(planner_->sketch().at.has_value());  // it has not seen the arm yet
  Configuration q = world_.frame.home;
  for (int i = 0; i < 3; ++i) q = planner_->decide(q, work_).motion.waypoints.back();
  planner_->decide(q, work_);
  const PlanSketch sketch = planner_->sketch();
  const ViewGraph& graph = planner_->graph();

  ASSERT_EQ(sketch.views.size(), static_cast<std::size_t>(graph.node_count()));
  std::int32_t last = -1;
  int visited = 0;
  for (const PlanSketch::View& view : sketch.views) {
    EXPECT_GT(view.id, last);
    last = view.id;
    const ViewNode& node = graph.node(static_cast<NodeId>(view.id));
    EXPECT_FALSE(node.removed);
    EXPECT_EQ(view.visited, node.visited);
    EXPECT_EQ(view.kind, node.view.kind);
    EXPECT_EQ(view.T_world_camera.matrix(), node.view.T_world_camera.matrix());
    visited += view.visited ? 1 : 0;
  }
  EXPECT_EQ(visited, 4);  // home and three more

  EXPECT_EQ(sketch.edges.size(), static_cast<std::size_t>(graph.edge_count()));
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const PlanSketch::Edge& edge : sketch.edges) {
    EXPECT_LT(edge.a, edge.b);
    pairs.emplace(edge.a, edge.b);
    EXPECT_EQ(graph.edge_time(static_cast<NodeId>(edge.a), static_cast<NodeId>(edge.b)),
              edge.time_s);
  }
  EXPECT_EQ(pairs.size(), sketch.edges.size());

  const std::vector<NodeId> path = planner_->path();
  ASSERT_EQ(sketch.path.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(sketch.path[i], static_cast<std::int32_t>(path[i]));
  }
  ASSERT_TRUE(sketch.at.has_value());
  EXPECT_EQ(graph.node(static_cast<NodeId>(*sketch.at)).view.q, q);
}

TEST_F(VmpPlannerTest, GrowSpendsItsTimeAndNoMore) {
  begin({});
  WorkMeter work;
  planner_->grow(0.05, work);
  const GraphBuilderOptions options;
  const double batch_s = options.batch * options.sampler.max_tries * costs_[Work::candidate];
  EXPECT_GE(work.seconds(costs_), 0.05);
  EXPECT_LE(work.seconds(costs_), 0.05 + batch_s + 1e-12);
  planner_->grow(0.05, work);  // what was spent too much is owed
  EXPECT_LE(work.seconds(costs_), 0.10 + batch_s + 1e-12);
}

TEST_F(VmpPlannerTest, FollowsThePathAndNeverVisitsANodeTwice) {
  Configuration q = world_.frame.home;
  std::vector<Configuration> visited = {q};
  for (int i = 0; i < 8; ++i) {
    const Decision decision = planner_->decide(q, work_);
    ASSERT_EQ(decision.action, Decision::Action::move);
    ASSERT_EQ(decision.motion.waypoints.front(), q);
    q = decision.motion.waypoints.back();
    for (const auto& before : visited) EXPECT_GT(joint_distance(before, q), 1e-6);
    visited.push_back(q);
  }
}

TEST_F(VmpPlannerTest, LookAheadEndsAPathButOneEdgeIsAlwaysTaken) {
  VmpOptions options;
  options.look_ahead_rad = 0.0;
  begin(options);
  planner_->grow(0.2, work_);
  Configuration q = world_.frame.home;
  for (int i = 0; i < 4; ++i) {
    WorkMeter work;
    const Decision decision = planner_->decide(q, work);
    ASSERT_EQ(decision.action, Decision::Action::move);
    EXPECT_GT(work.units(Work::expansion), 0) << "every edge needs a search of its own";
    q = decision.motion.waypoints.back();
  }
}

TEST_F(VmpPlannerTest, AnEdgeBlockedByTheNewMapIsRemovedAndThePathPlannedAnew) {
  const Configuration q = go_on_until_next_is_far();
  ASSERT_FALSE(planner_->path().empty());
  const NodeId next = planner_->path().front();
  const Configuration q_next = next_q();
  // A leaf turns up where the camera would go.
  block_around(camera_at(q_next), 0.02);
  ASSERT_FALSE(world_.checker.edge_free(q, q_next));
  const Decision decision = planner_->decide(q, work_);
  ASSERT_EQ(decision.action, Decision::Action::move);
  EXPECT_GT(joint_distance(decision.motion.waypoints.back(), q_next), 1e-6);
  // The node it stands at has lost the edge.
  for (std::size_t i = 0; i < planner_->graph().id_count(); ++i) {
    const auto id = static_cast<NodeId>(i);
    if (joint_distance(planner_->graph().node(id).view.q, q) < 1e-9) {
      EXPECT_FALSE(planner_->graph().edge_time(id, next).has_value());
    }
  }
}

TEST_F(VmpPlannerTest, APoseOffThePathGetsANodeAndAnEdgeBackToIt) {
  Decision decision = planner_->decide(world_.frame.home, work_);
  ASSERT_FALSE(planner_->path().empty());
  const NodeId next = planner_->path().front();
  Configuration q = decision.motion.waypoints.back();
  q[0] += 0.03;  // the arm stops beside its goal
  const int nodes = planner_->graph().node_count();
  decision = planner_->decide(q, work_);
  ASSERT_EQ(decision.action, Decision::Action::move);
  EXPECT_EQ(decision.motion.waypoints.front(), q);
  EXPECT_EQ(planner_->graph().node_count(), nodes + 1);
  EXPECT_EQ(decision.motion.waypoints.back(), planner_->graph().node(next).view.q)
      << "the path goes on where it was left";
}

TEST_F(VmpPlannerTest, OffThePathWithNoWayBackItPlansFromTheRealPose) {
  Configuration q = go_on_until_next_is_far();
  ASSERT_FALSE(planner_->path().empty());
  const Configuration q_next = next_q();
  q[0] += 0.03;
  block_around(camera_at(q_next), 0.02);
  const Decision decision = planner_->decide(q, work_);
  ASSERT_EQ(decision.action, Decision::Action::move);
  EXPECT_EQ(decision.motion.waypoints.front(), q);
  EXPECT_GT(joint_distance(decision.motion.waypoints.back(), q_next), 1e-6);
}

TEST_F(VmpPlannerTest, RandomWalkGoesOverTheSameGraphWithoutPredictions) {
  VmpOptions options;
  options.search = VmpOptions::Search::random_walk;
  begin(options);
  planner_->grow(0.2, work_);
  WorkMeter work;
  const Decision decision = planner_->decide(world_.frame.home, work);
  ASSERT_EQ(decision.action, Decision::Action::move);
  EXPECT_FALSE(decision.motion.predicted_gain.has_value());
  EXPECT_EQ(work.units(Work::view_cast), 0);
}

TEST_F(VmpPlannerTest, WithoutTargetsItIsStuckAfterItsPatience) {
  begin({});
  planner_->map_changed({});
  EXPECT_EQ(planner_->decide(world_.frame.home, work_).action, Decision::Action::wait);
  planner_->grow(VmpOptions{}.max_wait_s + 0.1, work_);
  EXPECT_EQ(planner_->decide(world_.frame.home, work_).action, Decision::Action::stuck);
}

}  // namespace
}  // namespace canopeer
