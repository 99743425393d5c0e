// Targets and distances inside the sampling region; the targets beside OctoMap.

#include <benchmark/benchmark.h>

#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/fusion.h"
#include "map_world.h"

namespace canopeer {
namespace {

void frontiers(benchmark::State& state) {
  std::size_t targets = 0;
  for (auto _ : state) {
    const FrontierTargets found = extract_frontiers(fused_map(), kSamplingRegion);
    targets = found.roi.size() + found.occupied.size() + found.border.size();
  }
  state.counters["targets"] = static_cast<double>(targets);
}
BENCHMARK(frontiers)->Unit(benchmark::kMicrosecond);

// Occupied and border targets only (an OcTree has no ROI), leaf by leaf.
void octomap_frontiers(benchmark::State& state) {
  const octomap::OcTree& tree = fused_octree();
  std::size_t targets = 0;
  for (auto _ : state) {
    targets = 0;
    for (auto leaf =
             tree.begin_leafs_bbx(point(kSamplingRegion.min()), point(kSamplingRegion.max()));
         leaf != tree.end_leafs_bbx(); ++leaf) {
      if (tree.isNodeOccupied(*leaf)) continue;
      bool open = false;
      for (int side = 0; side < 6 && !open; ++side) {
        octomap::OcTreeKey key = leaf.getKey();
        key[static_cast<unsigned>(side / 2)] = static_cast<octomap::key_type>(
            key[static_cast<unsigned>(side / 2)] + (side % 2) * 2 - 1);
        open = tree.search(key) == nullptr;
      }
      targets += open;
    }
  }
  state.counters["targets"] = static_cast<double>(targets);
}
BENCHMARK(octomap_frontiers)->Unit(benchmark::kMicrosecond);

void distance_field_rebuild(benchmark::State& state) {
  DistanceField field({kSamplingRegion, 0.15}, kResolution);
  for (auto _ : state) field.rebuild(fused_map());
  state.counters["MB"] = static_cast<double>(field.memory_bytes()) / 1e6;
}
BENCHMARK(distance_field_rebuild)->Unit(benchmark::kMillisecond);

void distance_field_update(benchmark::State& state) {
  VoxelMap after = fused_map();
  const BallScene::View& last = views()[kViews - 1];
  const std::vector<BlockKey> changed = fuse(after, last.frame, last.roi).changed;
  DistanceField field({kSamplingRegion, 0.15}, kResolution);
  field.rebuild(fused_map());
  bool forth = true;  // to the new map and back: the same blocks both times
  for (auto _ : state) {
    field.update(forth ? after : fused_map(), changed);
    forth = !forth;
  }
}
BENCHMARK(distance_field_update)->Unit(benchmark::kMillisecond);

void distance_field_query(benchmark::State& state) {
  DistanceField field({kSamplingRegion, 0.15}, kResolution);
  field.rebuild(fused_map());
  Rng rng(1, "queries");
  std::vector<Vec3> points;
  for (int i = 0; i < 4096; ++i) {
    points.emplace_back(rng.uniform(0.3, 1.3), rng.uniform(-1, 1), rng.uniform(-0.6, 0.6));
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(field.distance(points[i++ & 4095]));
}
BENCHMARK(distance_field_query);

}  // namespace
}  // namespace canopeer
