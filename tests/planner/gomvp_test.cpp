#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/planner/gomvp/gomvp_finder.h"
#include "planner_fixture.h"

namespace canopeer {
namespace {

using Objective = InspectionProblem::Objective;

std::vector<VoxelIndex> slab(int x, int edge) {
  std::vector<VoxelIndex> voxels;
  for (int y = 0; y < edge; ++y) {
    for (int z = 0; z < edge; ++z) voxels.emplace_back(x, y, z);
  }
  return voxels;
}

int count_kind(const std::vector<CoverTarget>& targets, TargetKind kind) {
  return static_cast<int>(std::count_if(targets.begin(), targets.end(),
                                        [&](const auto& one) { return one.kind == kind; }));
}

TEST(CoverTargets, AreOneACellAndEachKindHasItsShare) {
  GomvpOptions options;
  options.max_targets = 100;
  options.target_grid_m = 0.02;                                           // two voxels
  const FrontierTargets all = {slab(0, 40), slab(10, 40), slab(20, 40)};  // 400 cells each
  const auto targets = choose_targets(all, 0.01, options);
  EXPECT_EQ(count_kind(targets, TargetKind::roi), 50);
  EXPECT_EQ(count_kind(targets, TargetKind::occupied), 30);
  EXPECT_EQ(count_kind(targets, TargetKind::border), 20);
  std::set<std::tuple<int, int, int>> cells;
  for (const auto& target : targets) {
    const VoxelIndex& v = target.voxel;
    EXPECT_TRUE(cells.emplace(v.x() / 2, v.y() / 2, v.z() / 2).second);
  }
}

TEST(CoverTargets, OfAnEmptyKindGoToTheOthers) {
  GomvpOptions options;
  options.max_targets = 100;
  options.target_grid_m = 0.01;
  const auto targets = choose_targets({{}, slab(10, 4), slab(20, 40)}, 0.01, options);
  EXPECT_EQ(count_kind(targets, TargetKind::occupied), 16);
  EXPECT_EQ(count_kind(targets, TargetKind::border), 84);
  EXPECT_TRUE(choose_targets({}, 0.01, options).empty());
  options.max_targets = 1;
  EXPECT_EQ(choose_targets({slab(0, 3), {}, {}}, 0.01, options).size(), 1U);
}

TEST(CoverTargets, AreInOneCellOfTheGridOnce) {
  GomvpOptions options;
  options.target_grid_m = 0.1;
  const auto targets = choose_targets({slab(0, 10), slab(1, 10), slab(2, 10)}, 0.01, options);
  ASSERT_EQ(targets.size(), 1U);  // the ROI voxel comes first
  EXPECT_EQ(targets.front().kind, TargetKind::roi);
}

/// Free within [0, 40)³ voxels of 1 cm.
VoxelMap free_cube() {
  VoxelMap map;
  for (int x = 0; x < 40; ++x) {
    for (const VoxelIndex& voxel : slab(x, 40)) map.set_occupancy_log_odds(voxel, -1.0);
  }
  return map;
}

TEST(CoverTargets, AreSeenWhenNothingUnknownIsBesideThem) {
  VoxelMap map = free_cube();
  EXPECT_TRUE(is_seen(map, {{5, 5, 5}, TargetKind::roi}));
  EXPECT_FALSE(is_seen(map, {{0, 5, 5}, TargetKind::border}));
  const auto edge_unknown = [](TargetKind kind) {
    VoxelMap open;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          if (VoxelIndex(dx, dy, dz) == VoxelIndex(1, 1, 0)) continue;
          open.set_occupancy_log_odds(VoxelIndex(dx, dy, dz), -1.0);
        }
      }
    }
    return is_seen(open, {{0, 0, 0}, kind});
  };
  EXPECT_FALSE(edge_unknown(TargetKind::roi));  // of its 18 neighbours one is unknown
  EXPECT_TRUE(edge_unknown(TargetKind::occupied));
}

TEST(Sees, WhatLiesInTheFanBehindNothing) {
  VoxelMap map = free_cube();
  Pose camera = Pose::Identity();  // looks along z
  camera.translation() = Vec3(0.205, 0.205, 0.005);
  const ViewFan fan;
  EXPECT_TRUE(sees(map, camera, {0.205, 0.205, 0.395}, fan));
  EXPECT_TRUE(sees(map, camera, {0.305, 0.205, 0.305}, fan));
  EXPECT_FALSE(sees(map, camera, {0.395, 0.205, 0.055}, fan));  // outside the fan
  EXPECT_FALSE(sees(map, camera, {0.205, 0.205, 1.105}, fan));  // too far
  camera.translation().z() = 0.205;
  EXPECT_FALSE(sees(map, camera, {0.205, 0.205, 0.105}, fan));  // behind the camera
  camera.translation().z() = 0.005;
  map.set_occupancy_log_odds({20, 20, 20}, 1.0);
  EXPECT_FALSE(sees(map, camera, {0.205, 0.205, 0.395}, fan));
  EXPECT_TRUE(sees(map, camera, {0.205, 0.205, 0.155}, fan));
  // Through 0.2 m of unknown space.
  ViewFan short_fan;
  short_fan.max_unknown_m = 0.1;
  EXPECT_TRUE(sees(map, camera, {0.305, 0.205, 0.595}, fan));
  EXPECT_FALSE(sees(map, camera, {0.305, 0.205, 0.595}, short_fan));
}

ViewGraph random_view_graph(Rng& rng, int nodes) {
  ViewGraph graph;
  for (int i = 0; i < nodes; ++i) {
    ViewPose view;
    view.q = Configuration::Constant(6, static_cast<double>(i));
    graph.add(view);
    if (i > 0 && i + 2 < nodes)  // the last two stay alone
      graph.connect(static_cast<NodeId>(rng.index(static_cast<std::uint64_t>(i))),
                    static_cast<NodeId>(i), rng.uniform(0.1, 1.0));
  }
  for (int i = 0; i < nodes / 2; ++i) {
    graph.connect(static_cast<NodeId>(rng.index(static_cast<std::uint64_t>(nodes - 2))),
                  static_cast<NodeId>(rng.index(static_cast<std::uint64_t>(nodes - 2))),
                  rng.uniform(0.1, 1.0));
  }
  return graph;
}

TEST(GraphWays, AreTheQuickestOfAllAndTheirEdgesAreThere) {
  constexpr int kNodes = 20;
  constexpr double kObserve = 0.2;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed, "ways");
    const ViewGraph graph = random_view_graph(rng, kNodes);
    // All pairs by Floyd and Warshall
    std::vector<std::vector<double>> best(kNodes, std::vector<double>(kNodes, GraphWays::kNoWay));
    for (std::size_t i = 0; i < kNodes; ++i) {
      best[i][i] = 0.0;
      for (const auto& edge : graph.node(static_cast<NodeId>(i)).edges)
        best[i][static_cast<std::size_t>(edge.to)] = edge.time_s + kObserve;
    }
    for (std::size_t k = 0; k < kNodes; ++k) {
      for (auto& row : best) {
        for (std::size_t j = 0; j < kNodes; ++j) row[j] = std::min(row[j], row[k] + best[k][j]);
      }
    }
    const GraphWays ways(graph, NodeId{0}, kObserve);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const auto id = static_cast<NodeId>(i);
      if (best[0][i] == GraphWays::kNoWay) {
        EXPECT_EQ(ways.time_s(id), GraphWays::kNoWay);
        continue;
      }
      EXPECT_NEAR(ways.time_s(id), best[0][i], 1e-12);
      double sum = 0.0;
      NodeId from{0};
      for (const NodeId node : ways.way(id)) {
        sum += graph.edge_time(from, node).value() + kObserve;
        from = node;
      }
      EXPECT_EQ(from, id);
      EXPECT_NEAR(sum, best[0][i], 1e-12);
    }
  }
}

/// Programs that are solved in a moment.
PlannerOptions small_programs() {
  PlannerOptions options;
  options.gomvp.max_views = 15;
  options.gomvp.neighbors = 5;
  return options;
}

/// A few views of a run, as the waypoints of its motions.
std::vector<Configuration> walk(const std::string& name, int views) {
  test::PlannerFixture run(name, small_programs());
  std::vector<Configuration> stops;
  for (int i = 0; i < views; ++i) {
    EXPECT_TRUE(run.take_view()) << name << ", view " << i;
    run.planner->grow(0.2, run.work);
    stops.push_back(run.q);
  }
  EXPECT_GT(run.work.units(Work::simplex_row), 0) << name;
  return stops;
}

TEST(GomvpPlanner, GoesTheSameWayTwice) {
  for (const char* name : {"gomvp_recon", "gomvp_t"}) EXPECT_EQ(walk(name, 4), walk(name, 4));
}

TEST(GomvpPlanner, FollowsItsPathUntilAShareOfItsTargetsIsSeen) {
  PlannerOptions options = small_programs();
  options.gomvp.replan_share = 1.0;
  test::PlannerFixture whole("gomvp_recon", options);
  ASSERT_TRUE(whole.take_view());
  const auto length = whole.planner->sketch().path.size();
  ASSERT_GT(length, 2U);
  ASSERT_TRUE(whole.take_view());
  EXPECT_EQ(whole.planner->status().searches, 1 + whole.planner->status().blocked_edges);

  options.gomvp.replan_share = 0.01;
  test::PlannerFixture anew("gomvp_recon", options);
  ASSERT_TRUE(anew.take_view());
  ASSERT_TRUE(anew.take_view());
  EXPECT_GE(anew.planner->status().searches, 2);
}

TEST(GomvpPlanner, IsDoneWhenThereAreNoTargetsAndNotBefore) {
  test::PlannerFixture run("gomvp_recon", small_programs());
  ASSERT_TRUE(run.take_view());
  EXPECT_EQ(run.last.action, Decision::Action::move);
  run.planner->map_changed({});
  Decision last;
  for (int i = 0; i < 500; ++i) {  // the path planned before ends first
    last = run.planner->decide(run.q, run.work);
    if (last.action != Decision::Action::move) break;
    run.q = last.motion.waypoints.back();
  }
  EXPECT_EQ(last.action, Decision::Action::done);
}

TEST(GomvpFinder, OnlyChoosesViewsThatSeeTheirTargets) {
  test::PlannerFixture run("vmp", {});
  ASSERT_TRUE(run.take_view());
  ASSERT_TRUE(run.take_view());
  run.planner->grow(0.5, run.work);
  ViewGraph graph = dynamic_cast<VmpPlanner&>(*run.planner).graph();
  NodeId at{};
  for (std::size_t i = 0; i < graph.id_count(); ++i) {
    if (graph.node(static_cast<NodeId>(i)).visited) at = static_cast<NodeId>(i);
  }
  const VoxelMap& map = run.world.perception.map();
  const auto frontiers = extract_frontiers(map, run.world.frame.sampling_region_world);
  GomvpOptions options;
  options.max_views = 25;
  options.neighbors = 5;
  const auto targets = choose_targets(frontiers, map.resolution_m(), options);
  ASSERT_FALSE(targets.empty());
  const GraphWays ways(graph, at, 0.2);
  WorkMeter work;
  const auto views = choose_views(graph, ways, map, targets,
                                  std::vector<double>(targets.size(), 1.0), options, work);
  ASSERT_FALSE(views.empty());
  EXPECT_LE(views.size(), 25U);
  std::set<NodeId> once;
  for (const ChosenView& view : views) {
    EXPECT_TRUE(once.insert(view.node).second);
    EXPECT_FALSE(graph.node(view.node).visited);
    std::vector<int> seen;
    for (std::size_t j = 0; j < targets.size(); ++j) {
      const Vec3 p = voxel_centre(targets[j].voxel, map.resolution_m());
      if (sees(map, graph.node(view.node).view.T_world_camera, p, options.fan))
        seen.push_back(static_cast<int>(j));
    }
    EXPECT_EQ(view.targets, seen);
  }

  // And the path it makes goes along edges, to views that see all it promises.
  const CostTable costs;
  for (const auto objective : {Objective::cover, Objective::orienteering}) {
    GomvpFinder finder(options, objective);
    const PathQuery query{&graph,           at,     &map, &frontiers, &run.world.frame,
                          &run.world.robot, &costs, 1,    20.0};
    const ViewPath path = finder.find(query, work);
    ASSERT_FALSE(path.steps.empty());
    NodeId from = at;
    std::set<int> shown;
    for (const PathStep& step : path.steps) {
      ASSERT_TRUE(graph.edge_time(from, step.node).has_value());
      EXPECT_DOUBLE_EQ(step.time_s, *graph.edge_time(from, step.node) + options.observe_s);
      from = step.node;
    }
    for (const CoverTarget& target : finder.targets()) {
      const Vec3 p = voxel_centre(target.voxel, map.resolution_m());
      EXPECT_TRUE(std::any_of(path.steps.begin(), path.steps.end(), [&](const PathStep& step) {
        return sees(map, graph.node(step.node).view.T_world_camera, p, options.fan);
      }));
    }
    EXPECT_FALSE(finder.done());
    EXPECT_TRUE(finder.keeps(query, work));
    // It goes on from its state.
    GomvpFinder heir(options, objective);
    ASSERT_TRUE(heir.restore(finder.state()));
    EXPECT_EQ(heir.state(), finder.state());
    EXPECT_FALSE(heir.restore(finder.state().substr(0, 5)));
  }
}

}  // namespace
}  // namespace canopeer
