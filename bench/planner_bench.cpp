// The planner's kernels on one thread: search expansions with and without view casts inside beside
// the published way (sets of octree keys, copied along the path), graph building, and the time from
// a frame to a motion command. In front of Scenario 1, stop 1, side 1, 1 cm voxels.

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <vector>

#include "bench_rows.h"
#include "bench_threads.h"
#include "canopeer/detect/color_detector.h"
#include "canopeer/map/frontier_index.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/planner/vmp/vmp_planner.h"
#include "canopeer/search/path_tree.h"
#include "canopeer/search/random_walk.h"
#include "canopeer/search/view_casts.h"
#include "canopeer/viewgraph/graph_builder.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

constexpr int kFrames = 4;  // before anything is measured
constexpr int kGraphNodes = 2000;
constexpr int kPathLength = 10;
constexpr int kPaths = 64;
const ViewFan kFan{.columns = 9, .rows = 7};  // the published code's 63 rays

double cpu_now_s() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A segment with a few frames fused.
class Segment {
 public:
  Segment() : targets_(world.home.change.targets) {
    Rng rng(1, "bench views");
    const ViewSampler sampler(world.frame, world.robot, world.ik, {});
    WorkMeter work;
    for (int taken = 0; taken < kFrames;) {
      const TargetSampler drawn =
          sampler.targets_in_reach(targets_, world.mission.map.resolution_m, {});
      const auto view = sampler.sample(world.perception.map(), world.checker, drawn, rng, work);
      if (!view) continue;
      look_from(view->q);
      ++taken;
    }
  }

  void look_from(const Configuration& q) {
    const Ports ports = world.simulation.ports();
    static_cast<void>(ports.arm->start({{ports.arm->configuration(), q}}).value());
    static_cast<void>(ports.arm->finish().value());
    WorkMeter work;
    StageTimer timer;
    targets_ = world.perception
                   .observe(ports.camera->capture().value(), world.frame.sampling_region_world,
                            work, timer)
                   .value()
                   .change.targets;
  }
  [[nodiscard]] const FrontierTargets& targets() const { return targets_; }
  [[nodiscard]] const VoxelMap& map() const { return world.perception.map(); }

  test::PlanningFixture world;

 private:
  FrontierTargets targets_;
};

Segment& segment() {
  static Segment one;
  return one;
}

/// A graph of as many nodes as it comes to, and its builder.
struct Built {
  ViewGraph graph;
  std::unique_ptr<GraphBuilder> builder;
  NodeId start{};

  explicit Built(int max_nodes) {
    GraphBuilderOptions options;
    options.max_nodes = max_nodes;
    auto& world = segment().world;
    builder = std::make_unique<GraphBuilder>(graph, world.frame, world.robot, world.ik, options, 7);
    builder->set_targets(segment().map(), segment().targets(), {});
    WorkMeter work;
    start = builder->add_start(
        world.frame.home, world.checker,
        world.frame.T_world_base * world.robot.T_base_camera(world.frame.home), work);
  }
  void grow() {
    WorkMeter work;
    builder->grow(segment().map(), segment().world.checker, work);
  }
};

/// A full graph with all view casts in place, and a search tree over it that reaches as far as
/// paths of ten views.
struct Search {
  Built built{kGraphNodes};
  std::vector<std::pair<NodeId, NodeId>> grown;  // node and predecessor, in order
  std::vector<NodeId> ends;                      // the tree's nodes ten views from the root

  Search() {
    while (!built.builder->resting()) built.grow();
    for (std::size_t i = 0; i < built.graph.id_count(); ++i) {
      ViewNode& node = built.graph.node(static_cast<NodeId>(i));
      if (!node.removed) node.cast = cast_view(segment().map(), node.view.T_world_camera, kFan);
    }
    // Walks from the root: where one comes to a node of the tree it goes on from there.
    Rng rng(3, "bench paths");
    std::vector<NodeId> from(built.graph.id_count());
    std::vector<int> depth(built.graph.id_count(), -1);
    depth[static_cast<std::size_t>(built.start)] = 0;
    for (int walks = 0; walks < 100000 && ends.size() < kPaths; ++walks) {
      NodeId at = built.start;
      for (const auto& step : random_walk(built.graph, built.start, kPathLength, rng).steps) {
        const auto next = static_cast<std::size_t>(step.node);
        const int here = depth[static_cast<std::size_t>(at)];
        if (depth[next] < 0 && here == kPathLength) break;
        if (depth[next] < 0) {
          depth[next] = here + 1;
          grown.emplace_back(step.node, at);
          if (depth[next] == kPathLength) ends.push_back(step.node);
        }
        at = step.node;
      }
    }
  }

  [[nodiscard]] PathTree tree() const {
    PathTree tree(built.graph, built.start);
    for (const auto& [id, from] : grown) {
      tree.expand(from);
      tree.attach(id, built.graph.edge_time(from, id).value());
    }
    return tree;
  }
  /// Of each end, the neighbours that are not on the way to it. New ones only: those the tree has
  /// not come to yet, each once.
  [[nodiscard]] std::vector<std::vector<ViewEdge>> neighbors(const PathTree& tree,
                                                             bool new_only) const {
    std::vector<bool> taken(built.graph.id_count(), false);
    std::vector<std::vector<ViewEdge>> found;
    for (const NodeId end : ends) {
      found.emplace_back();
      const std::vector<NodeId> path = path_to(end);
      for (const auto& edge : built.graph.node(end).edges) {
        if (std::find(path.begin(), path.end(), edge.to) != path.end()) continue;
        const auto id = static_cast<std::size_t>(edge.to);
        if (edge.to == built.start || (new_only && (taken[id] || tree.reached(edge.to)))) continue;
        taken[id] = true;
        found.back().push_back(edge);
      }
    }
    return found;
  }
  /// The views on the way to an end.
  [[nodiscard]] std::vector<NodeId> path_to(NodeId end) const {
    std::vector<NodeId> path;
    for (auto step = grown.rbegin(); step != grown.rend(); ++step) {
      if (step->first != end) continue;
      path.push_back(end);
      end = step->second;
    }
    return path;
  }
};

Search& search() {
  static Search one;
  return one;
}

/// As the search does before it expands a node.
void cast_anew(const std::vector<ViewEdge>& neighbors) {
  ViewGraph& graph = search().built.graph;
  std::vector<NodeId> ids;
  for (const auto& edge : neighbors) {
    graph.node(edge.to).cast.reset();
    ids.push_back(edge.to);
  }
  WorkMeter work;
  ensure_casts(graph, ids, segment().map(), kFan, work);
}

/// Expands the tree's ends: C(n), then U of each neighbour. Cold: only neighbours that are come to
/// for the first time, their views cast then, as in a search after a frame that changed everything.
void expand_ends(benchmark::State& state, bool cold) {
  PathTree tree = search().tree();
  const auto neighbors = search().neighbors(tree, cold);
  const PathTree fresh = tree;
  std::int64_t evaluated = 0;
  double sum = 0.0;
  std::size_t i = 0;
  const auto expand = [&] {
    tree.expand(search().ends[i]);
    if (cold) cast_anew(neighbors[i]);
    for (const auto& edge : neighbors[i]) sum += tree.utility_behind(edge.to, edge.time_s);
    evaluated += static_cast<std::int64_t>(neighbors[i].size());
    i = (i + 1) % neighbors.size();
  };
  if (!cold) {  // the first time prepares the sets
    for (std::size_t k = 0; k < neighbors.size(); ++k) expand();
    evaluated = 0;
  }
  for (auto _ : state) {
    if (cold && i == 0) {
      state.PauseTiming();
      tree = fresh;
      state.ResumeTiming();
    }
    expand();
  }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(evaluated);
}

void expansions(benchmark::State& state) { expand_ends(state, false); }
void expansions_cold(benchmark::State& state) { expand_ends(state, true); }
BENCHMARK(expansions);
void expansions_cold_two_threads(benchmark::State& state) {
  const Threads two(2);
  expand_ends(state, true);
}
BENCHMARK(expansions_cold);
BENCHMARK(expansions_cold_two_threads)->UseRealTime();

// --- the published way ---

using octomap::KeySet;

octomap::point3d point(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// The same map as an octree.
const octomap::OcTree& octree() {
  static const octomap::OcTree tree = [] {
    const VoxelMap& map = segment().map();
    octomap::OcTree copy(map.resolution_m());
    for (const BlockKey key : map.block_keys()) {
      for_each_voxel(key, map.block(key)->observed, [&](const VoxelIndex& v) {
        copy.setNodeValue(point(voxel_centre(v, map.resolution_m())),
                          static_cast<float>(map.occupancy_log_odds(v)), true);
      });
    }
    copy.updateInnerOccupancy();
    return copy;
  }();
  return tree;
}

KeySet visible_unknown(const Pose& T_world_camera) {
  const octomap::OcTree& tree = octree();
  KeySet unknown;
  octomap::KeyRay ray;
  for (int row = 0; row < kFan.rows; ++row) {
    for (int column = 0; column < kFan.columns; ++column) {
      const double x = std::tan(kFan.fov_x_rad / 2) * (2.0 * column / (kFan.columns - 1) - 1.0);
      const double y = std::tan(kFan.fov_y_rad / 2) * (2.0 * row / (kFan.rows - 1) - 1.0);
      const Vec3 end = T_world_camera * (kFan.depth_m * Vec3(x, y, 1.0));
      tree.computeRayKeys(point(T_world_camera.translation()), point(end), ray);
      for (const auto& key : ray) {
        const auto* node = tree.search(key);
        if (node == nullptr) {
          unknown.insert(key);
        } else if (tree.isNodeOccupied(node)) {
          break;
        }
      }
    }
  }
  return unknown;
}

/// For each neighbour: its view cast, the path's set copied, the union, its size.
void expansions_octomap(benchmark::State& state) {
  constexpr std::size_t kEnds = 4;
  const PathTree tree = search().tree();
  const auto neighbors = search().neighbors(tree, true);
  const auto cells_of = [](NodeId id) {
    return visible_unknown(search().built.graph.node(id).view.T_world_camera);
  };
  std::vector<KeySet> covered;
  for (std::size_t k = 0; k < kEnds; ++k) {
    covered.emplace_back();
    for (const NodeId id : search().path_to(search().ends[k])) {
      const KeySet cells = cells_of(id);
      covered.back().insert(cells.begin(), cells.end());
    }
  }
  std::int64_t evaluated = 0;
  std::size_t sum = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    for (const auto& edge : neighbors[i]) {
      KeySet along = covered[i];
      const KeySet cells = cells_of(edge.to);
      along.insert(cells.begin(), cells.end());
      sum += along.size();
      ++evaluated;
    }
    i = (i + 1) % kEnds;
  }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(evaluated);
}
BENCHMARK(expansions_octomap);

// --- the graph ---

/// From nothing, for one second of one core.
void graph_1s(benchmark::State& state) {
  double nodes = 0.0;
  double degree = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    Built built(1000000);
    state.ResumeTiming();
    const double begin_s = cpu_now_s();
    while (cpu_now_s() - begin_s < 1.0 && !built.builder->resting()) built.grow();
    nodes = built.graph.node_count();
    degree = 2.0 * built.graph.edge_count() / nodes;
  }
  state.counters["nodes"] = nodes;
  state.counters["degree"] = degree;
}
BENCHMARK(graph_1s)->Iterations(1)->Unit(benchmark::kMillisecond);

// --- a whole step ---

/// From a frame to the first motion command: detecting, fusing, distances, targets, the graph's
/// clean-up and the search, which casts anew every view that the frame made out of date. The fruit
/// map is brought up to date aside.
void replan(benchmark::State& state) {
  constexpr int kSteps = 24;
  std::vector<double> took_s;
  std::vector<double> planner_s;  // of it, without detecting and fusing
  double nodes = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    test::PlanningFixture world;
    const ColorDetector detector;
    auto& map = const_cast<VoxelMap&>(world.perception.map());
    auto& field = const_cast<DistanceField&>(world.perception.field());
    FrontierIndex frontiers(world.frame.sampling_region_world, map.resolution_m());
    frontiers.rebuild(map);
    CostTable free;
    VmpOptions options;
    options.builder.max_nodes = 1000;
    options.look_ahead_rad = 0.0;  // a search at every view
    VmpPlanner planner(options);
    PlanningScene scene{.robot = &world.robot,
                        .ik = &world.ik,
                        .map = &map,
                        .checker = &world.checker,
                        .judge = &world.simulation.judge().checker(),
                        .costs = &free,
                        .segment = world.frame,
                        .seed = 1};
    planner.begin_segment(scene);
    planner.map_changed(world.home.change);
    Configuration q = world.frame.home;
    free[Work::candidate] = 1e-6;
    const Ports ports = world.simulation.ports();
    for (int step = 0; step <= kSteps; ++step) {
      // The graph is full when the frame comes, as it is after the arm's motion.
      for (int i = 0; i < 2000 && planner.status().graph_nodes < 1000; ++i) {
        WorkMeter work;
        planner.grow(1e-3, work);
      }
      nodes += planner.status().graph_nodes;
      const RgbdFrame frame = ports.camera->capture().value();
      WorkMeter work;
      state.ResumeTiming();
      const double begin_s = cpu_now_s();
      const Detection seen = detector.detect(frame).value();
      MapChange change;
      change.blocks = fuse(map, frame, seen.fruit).changed;
      const double fused_s = cpu_now_s();
      field.update(map, change.blocks);
      frontiers.update(map, change.blocks);
      change.targets = frontiers.targets();
      planner.map_changed(std::move(change));
      const Decision decision = planner.decide(q, work);
      const double end_s = cpu_now_s();
      took_s.push_back(end_s - begin_s);
      planner_s.push_back(end_s - fused_s);
      state.PauseTiming();
      if (decision.action != Decision::Action::move) continue;
      static_cast<void>(ports.arm->start({decision.motion.waypoints}).value());
      static_cast<void>(ports.arm->finish().value());
      q = ports.arm->configuration();
    }
    state.ResumeTiming();
  }
  std::sort(took_s.begin(), took_s.end());
  std::sort(planner_s.begin(), planner_s.end());
  state.counters["p50_ms"] = 1e3 * took_s[took_s.size() / 2];
  state.counters["p95_ms"] = 1e3 * took_s[took_s.size() * 95 / 100];
  state.counters["after_fusing_p95_ms"] = 1e3 * planner_s[planner_s.size() * 95 / 100];
  state.counters["nodes"] = nodes / static_cast<double>(took_s.size());
}
BENCHMARK(replan)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  const canopeer::Threads one(1);
  using canopeer::BenchRow;
  const std::vector<BenchRow> rows = {
      {.name = "planner.expansions_cold",
       .ours = "expansions_cold",
       .baseline = "expansions_octomap",
       .unit = "1/s"},
      // By the clock: the search casts a node's neighbours in parallel.
      {.name = "planner.expansions_cold_two_threads",
       .ours = "expansions_cold_two_threads",
       .baseline = "expansions_octomap",
       .unit = "1/s"},
      {.name = "planner.expansions",
       .ours = "expansions",
       .baseline = "expansions_octomap",
       .unit = "1/s"},
      // The published graph builder: 92 nodes in 5 s of one thread.
      {.name = "planner.graph_1s",
       .ours = "graph_1s",
       .unit = "nodes",
       .counter = "nodes",
       .more_is_better = true,
       .stated = 92.0 / 5.0},
      {.name = "planner.graph_1s_degree",
       .ours = "graph_1s",
       .unit = "edges",
       .counter = "degree",
       .more_is_better = true},
      {.name = "planner.replan_p95", .ours = "replan", .unit = "p95_ms", .counter = "p95_ms"},
      // Of it, without detecting the fruit pixels and fusing the frame.
      {.name = "planner.replan_after_fusing_p95",
       .ours = "replan",
       .unit = "p95_ms",
       .counter = "after_fusing_p95_ms"},
  };
  return canopeer::run_benchmarks(argc, argv, rows);
}
