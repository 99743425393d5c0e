// Graph building, and the time from a frame to a motion command.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "canopeer/detect/color_detector.h"
#include "canopeer/map/frontier_index.h"
#include "canopeer/planner/vmp/vmp_planner.h"
#include "planner_segment.h"

namespace canopeer {
namespace {

double cpu_now_s() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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
