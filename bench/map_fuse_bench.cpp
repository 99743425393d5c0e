// Frames fused into the map, and what the map weighs, beside OctoMap.

#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <optional>

#include "bench_threads.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier_index.h"
#include "canopeer/map/fusion.h"
#include "canopeer/map/map_snapshots.h"
#include "map_world.h"
#include "octomap_oracle.h"

namespace canopeer {
namespace {

double thread_cpu_ms() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

VoxelMapOptions resolution(double metres) {
  VoxelMapOptions options;
  options.resolution_m = metres;
  return options;
}

using FuseMode = FuseResult (*)(VoxelMap&, const RgbdFrame&, const Mask&, const FusionOptions&);

// Each iteration takes the next of the views; after the last one the map starts empty again. So no
// frame is fused twice, and on average the map holds half of the views.
void fuse_views(benchmark::State& state, FuseMode mode, const VoxelMapOptions& options,
                const FusionOptions& fusion = {}) {
  std::optional<VoxelMap> map(options);
  std::int64_t voxels = 0;
  std::size_t frame = 0;
  for (auto _ : state) {
    if (frame == views().size()) {
      state.PauseTiming();
      map.emplace(options);
      frame = 0;
      state.ResumeTiming();
    }
    const BallScene::View& view = views()[frame++];
    voxels += mode(*map, view.frame, view.roi, fusion).updated_voxels;
  }
  state.counters["voxels"] =
      benchmark::Counter(static_cast<double>(voxels), benchmark::Counter::kAvgIterations);
}

void fuse_new(benchmark::State& state) { fuse_views(state, fuse, resolution(kResolution)); }
BENCHMARK(fuse_new)->Unit(benchmark::kMillisecond)->Iterations(6 * kViews);

void fuse_new_scalar(benchmark::State& state) {
  FusionOptions scalar;
  scalar.simd = SimdLevel::scalar;
  fuse_views(state, fuse, resolution(kResolution), scalar);
}
BENCHMARK(fuse_new_scalar)->Unit(benchmark::kMillisecond)->Iterations(2 * kViews);

void fuse_new_5mm(benchmark::State& state) { fuse_views(state, fuse, resolution(0.005)); }
BENCHMARK(fuse_new_5mm)->Unit(benchmark::kMillisecond)->Iterations(2 * kViews);

// By the clock: on a machine with a second core to spare.
void fuse_new_two_threads(benchmark::State& state) {
  const Threads two(2);
  fuse_views(state, fuse, resolution(kResolution));
}
void fuse_new_by_the_clock(benchmark::State& state) {
  fuse_views(state, fuse, resolution(kResolution));
}
BENCHMARK(fuse_new_two_threads)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(6 * kViews)
    ->UseRealTime();
BENCHMARK(fuse_new_by_the_clock)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(6 * kViews)
    ->UseRealTime();

void fuse_exact_new(benchmark::State& state) {
  fuse_views(state, fuse_exact, resolution(kResolution));
}
BENCHMARK(fuse_exact_new)->Unit(benchmark::kMillisecond)->Iterations(kViews);

void fuse_exact_new_5mm(benchmark::State& state) {
  fuse_views(state, fuse_exact, resolution(0.005));
}
BENCHMARK(fuse_exact_new_5mm)->Unit(benchmark::kMillisecond)->Iterations(2);

// The same views again and again: what a camera that hardly moves costs.
void fuse_again(benchmark::State& state) {
  VoxelMap map = fused_map();
  std::size_t frame = 0;
  for (auto _ : state) {
    const BallScene::View& view = views()[frame++ % kViews];
    benchmark::DoNotOptimize(fuse(map, view.frame, view.roi).updated_voxels);
  }
}
BENCHMARK(fuse_again)->Unit(benchmark::kMillisecond)->Iterations(6 * kViews);

// All that a new frame changes, inside the sampling region.
void update_all(benchmark::State& state) {
  struct World {
    VoxelMap map;
    FrontierIndex frontiers{kSamplingRegion, kResolution};
    DistanceField field{{kSamplingRegion, 0.15}, kResolution};
  };
  std::optional<World> world(std::in_place);
  std::size_t frame = 0;
  for (auto _ : state) {
    if (frame == views().size()) {
      state.PauseTiming();
      world.emplace();
      frame = 0;
      state.ResumeTiming();
    }
    const BallScene::View& view = views()[frame++];
    const FuseResult fused = fuse(world->map, view.frame, view.roi);
    world->frontiers.update(world->map, fused.changed);
    benchmark::DoNotOptimize(world->frontiers.targets().border.size());
    world->field.update(world->map, fused.changed);
  }
}
BENCHMARK(update_all)->Unit(benchmark::kMillisecond)->Iterations(3 * kViews);

double fuse_ms(VoxelMap& map, const RgbdFrame& frame, const Mask& roi) {
  const double start_ms = thread_cpu_ms();
  fuse(map, frame, roi);
  return thread_cpu_ms() - start_ms;
}

// The views again every metre of a 50 m row. The machine's speed drifts over the minute this takes:
// a map that starts empty every five metres gets each frame too, and how much longer the large map
// takes than that one is what must not grow.
void row_50m(benchmark::State& state) {
  constexpr int kMetres = 50, kEnd = 5;
  for (auto _ : state) {
    VoxelMap map, small;
    double first_ms = 0.0, last_ms = 0.0, first_small_ms = 0.0, last_small_ms = 0.0;
    for (int metre = 0; metre < kMetres; ++metre) {
      if (metre % kEnd == 0) small = VoxelMap();
      for (const BallScene::View& view : views()) {
        RgbdFrame frame = view.frame;
        frame.T_world_camera.translation().y() += metre;
        const double ms = fuse_ms(map, frame, view.roi) / (kEnd * kViews);
        const double small_ms = fuse_ms(small, frame, view.roi) / (kEnd * kViews);
        if (metre >= kEnd && metre < 2 * kEnd) first_ms += ms, first_small_ms += small_ms;
        if (metre >= kMetres - kEnd) last_ms += ms, last_small_ms += small_ms;
      }
    }
    MapSnapshots snapshots;
    const double start_ms = thread_cpu_ms();
    snapshots.publish(map);
    state.counters["snapshot_us"] = (thread_cpu_ms() - start_ms) * 1e3;
    state.counters["first_ms"] = first_ms;
    state.counters["last_ms"] = last_ms;
    state.counters["growth_with_drift"] = last_ms / first_ms;
    state.counters["growth"] = last_ms / last_small_ms / (first_ms / first_small_ms);
    state.counters["MB"] = static_cast<double>(map.memory_bytes()) / 1e6;
    state.counters["m3"] = static_cast<double>(map.observed_voxels()) * std::pow(kResolution, 3);
  }
}
BENCHMARK(row_50m)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(1);

void octomap_fuse_at(benchmark::State& state, double resolution_m) {
  octomap::OcTree tree(resolution_m);
  const octomap::Pointcloud cloud = octomap_cloud(views()[0].frame);
  for (auto _ : state) {
    tree.insertPointCloud(cloud, point(views()[0].frame.T_world_camera.translation()), 3.0);
  }
}
void octomap_fuse(benchmark::State& state) { octomap_fuse_at(state, kResolution); }
void octomap_fuse_5mm(benchmark::State& state) { octomap_fuse_at(state, 0.005); }
BENCHMARK(octomap_fuse_5mm)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(1);
BENCHMARK(octomap_fuse)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(1);

void memory(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(fused_map().observed_voxels());
  state.counters["MB"] = static_cast<double>(fused_map().memory_bytes()) / 1e6;
  state.counters["voxels"] = static_cast<double>(fused_map().observed_voxels());
}
BENCHMARK(memory)->Iterations(1)->Repetitions(1);

// The same occupancy, and ROI as a second tree, both pruned.
void octomap_memory(benchmark::State& state) {
  octomap::OcTree occupancy(kResolution), roi(kResolution);
  for (const BlockKey key : fused_map().block_keys()) {
    for_each_voxel(key, fused_map().block(key)->observed, [&](const VoxelIndex& v) {
      const octomap::point3d p = point(voxel_centre(v, kResolution));
      occupancy.setNodeValue(p, static_cast<float>(fused_map().occupancy_log_odds(v)), true);
      const double fruit = fused_map().roi_log_odds(v);
      if (fruit != 0.0) roi.setNodeValue(p, static_cast<float>(fruit), true);
    });
  }
  for (auto _ : state) {
    for (octomap::OcTree* tree : {&occupancy, &roi}) {
      tree->updateInnerOccupancy();
      tree->prune();
    }
  }
  state.counters["MB"] = static_cast<double>(occupancy.memoryUsage() + roi.memoryUsage()) / 1e6;
}
BENCHMARK(octomap_memory)->Iterations(1)->Repetitions(1);

}  // namespace
}  // namespace canopeer
