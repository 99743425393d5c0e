// What each step of perception takes of one thread, in processor time, on a map that grows frame by
// frame from the home frame on.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <string>
#include <utility>

#include "perception_film.h"
#include "perception_load.h"
#include "support/must.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

constexpr std::size_t kMerged = 4;  // frames that the planner hears of at once: 0.25 s at 15 Hz

double cpu_now_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// The first stop after its home frame, with a planner whose graph is full and searched.
struct Stop {
  Stop() {
    VmpOptions options;
    options.builder.max_nodes = 1000;
    planner =
        begun_planner(options, planning_scene(world, world.simulation.judge().checker(), costs),
                      world.home.change);
    while (planner->status().graph_nodes < options.builder.max_nodes) {
      const auto task = planner->next_task();
      if (!task) break;
      task->run();
      WorkMeter work;
      planner->finish_task(*task, work);
    }
    WorkMeter work;
    static_cast<void>(planner->decide(world.frame.home, work));
  }

  std::shared_ptr<const MapSnapshot> snapshot() const {
    return std::make_shared<const MapSnapshot>(world.perception.map(), world.perception.field(),
                                               world.checker);
  }
  void tell(MapChange change) {
    change.snapshot = snapshot();
    planner->map_changed(std::move(change));
  }

  test::PlanningFixture world;
  CostTable costs;
  std::unique_ptr<VmpPlanner> planner;
};

/// Adds the block keys that are new; both are sorted.
void add_blocks(std::vector<BlockKey>& blocks, const std::vector<BlockKey>& more) {
  const auto middle = static_cast<std::ptrdiff_t>(blocks.size());
  blocks.insert(blocks.end(), more.begin(), more.end());
  std::inplace_merge(blocks.begin(), blocks.begin() + middle, blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

/// Means of the steps: of those for each frame, and of those after kMerged frames.
void steps(benchmark::State& state) {
  std::map<std::string, double> sums_ms;
  int settled = 0;
  for (auto _ : state) {
    state.PauseTiming();
    static_cast<void>(film());
    Stop stop;
    Perception& perception = stop.world.perception;
    const Box& region = stop.world.frame.sampling_region_world;
    state.ResumeTiming();
    double last_ms = cpu_now_ms();
    const auto done = [&](const char* step) {
      sums_ms[step] += cpu_now_ms() - std::exchange(last_ms, cpu_now_ms());
    };
    std::vector<BlockKey> changed;
    for (std::size_t i = 0; i < film().size(); ++i) {
      const RgbdFrame& frame = film()[i].frame;
      last_ms = cpu_now_ms();
      const Detection seen = must(perception.detect(frame));
      done("detect");
      const FuseResult fused = perception.fuse(frame, seen.fruit);
      done("fuse");
      perception.update_fruits(frame, seen.fruit);
      done("fruit_map");
      add_blocks(changed, fused.changed);
      if ((i + 1) % kMerged != 0) continue;
      ++settled;
      last_ms = cpu_now_ms();
      MapChange change;
      change.blocks = std::exchange(changed, {});
      perception.update_distances(change.blocks);
      done("distances");
      change.targets = perception.update_targets(region, change.blocks);
      done("targets");
      change.snapshot = stop.snapshot();
      done("snapshot");
      stop.planner->map_changed(std::move(change));
      done("map_changed");
    }
  }
  const double frames = static_cast<double>(film().size());
  for (const auto& [step, ms] : sums_ms) {
    const bool per_frame = step == "detect" || step == "fuse" || step == "fruit_map";
    state.counters[step + "_ms"] = ms / (per_frame ? frames : settled);
  }
}
BENCHMARK(steps)->Iterations(1)->Unit(benchmark::kMillisecond);

/// One frame through everything, in the mean; `merged` frames settled and told at once.
void frame(benchmark::State& state, std::size_t merged) {
  double took_ms = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    static_cast<void>(film());
    Stop stop;
    Perception& perception = stop.world.perception;
    const Box& region = stop.world.frame.sampling_region_world;
    WorkMeter work;
    StageTimer timer;
    state.ResumeTiming();
    const double begin_ms = cpu_now_ms();
    for (std::size_t i = 0; i < film().size(); ++i) {
      benchmark::DoNotOptimize(must(perception.take_in(film()[i].frame, work, timer)));
      if ((i + 1) % merged == 0) stop.tell(perception.settle(region, work, timer));
    }
    took_ms = cpu_now_ms() - begin_ms;
  }
  state.counters["frame_ms"] = took_ms / static_cast<double>(film().size());
}

void frame_merged(benchmark::State& state) { frame(state, kMerged); }
BENCHMARK(frame_merged)->Iterations(1)->Unit(benchmark::kMillisecond);

/// As views are: Perception::observe, and the planner told of each.
void frame_as_view(benchmark::State& state) { frame(state, 1); }
BENCHMARK(frame_as_view)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace canopeer
