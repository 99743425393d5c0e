// What a view shows of the map and a path of views together, beside OctoMap.

#include <benchmark/benchmark.h>

#include <cmath>

#include "canopeer/map/view_cast.h"
#include "canopeer/map/voxel_union.h"
#include "map_world.h"

namespace canopeer {
namespace {

ViewFan fan_of(std::int64_t rays) {
  ViewFan fan;
  fan.columns = rays == 63 ? 9 : rays == 192 ? 16 : 40;
  fan.rows = rays == 63 ? 7 : rays == 192 ? 12 : 30;
  return fan;
}

void view_cast(benchmark::State& state) {
  const ViewFan fan = fan_of(state.range(0));
  std::int64_t unknown = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    unknown += cast_view(fused_map(), view_poses()[i++ % view_poses().size()], fan).unknown.count();
  }
  state.counters["unknown"] =
      benchmark::Counter(static_cast<double>(unknown), benchmark::Counter::kAvgIterations);
}
BENCHMARK(view_cast)->Arg(63)->Arg(192)->Arg(1200)->Unit(benchmark::kMicrosecond);

// As the reference does it: the keys of each ray up to the first occupied voxel, unknown ones into
// one KeySet; free and occupied ones into two more, where `all` is not null.
struct OtherKeys {
  octomap::KeySet free, occupied;
};
octomap::KeySet octomap_cast(const Pose& T_world_camera, const ViewFan& fan,
                             OtherKeys* all = nullptr) {
  const octomap::OcTree& tree = fused_octree();
  const octomap::point3d from = point(T_world_camera.translation());
  octomap::KeySet cells;
  octomap::KeyRay ray;
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column < fan.columns; ++column) {
      const Vec3 end(std::tan(fan.fov_x_rad / 2) * (2.0 * column / (fan.columns - 1) - 1.0),
                     std::tan(fan.fov_y_rad / 2) * (2.0 * row / (fan.rows - 1) - 1.0), 1.0);
      tree.computeRayKeys(from, point(T_world_camera * end), ray);
      for (const octomap::OcTreeKey& key : ray) {
        const octomap::OcTreeNode* node = tree.search(key);
        if (node == nullptr) {
          cells.insert(key);
        } else if (tree.isNodeOccupied(node)) {
          if (all != nullptr) all->occupied.insert(key);
          break;
        } else if (all != nullptr) {
          all->free.insert(key);
        }
      }
    }
  }
  return cells;
}

void octomap_view_cast(benchmark::State& state) {
  const ViewFan fan = fan_of(state.range(0));
  std::size_t unknown = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    unknown += octomap_cast(view_poses()[i++ % view_poses().size()], fan).size();
  }
  state.counters["unknown"] =
      benchmark::Counter(static_cast<double>(unknown), benchmark::Counter::kAvgIterations);
}
BENCHMARK(octomap_view_cast)->Arg(63)->Arg(192)->Arg(1200)->Unit(benchmark::kMicrosecond);

// The reference's own way: it keeps the three kinds apart, and so does cast_view_all().
void octomap_view_cast_all(benchmark::State& state) {
  const ViewFan fan = fan_of(state.range(0));
  std::size_t seen = 0, i = 0;
  for (auto _ : state) {
    OtherKeys others;
    seen += octomap_cast(view_poses()[i++ % view_poses().size()], fan, &others).size();
    seen += others.free.size() + others.occupied.size();
  }
  state.counters["seen"] =
      benchmark::Counter(static_cast<double>(seen), benchmark::Counter::kAvgIterations);
}
BENCHMARK(octomap_view_cast_all)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

void view_cast_all(benchmark::State& state) {
  const ViewFan fan = fan_of(state.range(0));
  std::int64_t seen = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    const SeenVoxels all = cast_view_all(fused_map(), view_poses()[i++ % view_poses().size()], fan);
    seen += all.unknown.count() + all.free.count() + all.occupied.count();
  }
  state.counters["seen"] =
      benchmark::Counter(static_cast<double>(seen), benchmark::Counter::kAvgIterations);
}
BENCHMARK(view_cast_all)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

// The union of the sets along a path of ten views.
constexpr std::size_t kPath = 10;

void view_union(benchmark::State& state) {
  std::vector<ViewCast> casts;
  for (std::size_t i = 0; i < kPath; ++i) {
    casts.push_back(cast_view(fused_map(), view_poses()[i], fan_of(state.range(0))));
  }
  VoxelUnion seen;
  std::int64_t unknown = 0;
  for (auto _ : state) {
    seen.clear();
    for (const ViewCast& cast : casts) seen.add(cast.unknown);
    benchmark::DoNotOptimize(unknown = seen.count());
  }
  state.counters["unknown"] = static_cast<double>(unknown);
}
BENCHMARK(view_union)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

void octomap_view_union(benchmark::State& state) {
  std::vector<octomap::KeySet> casts;
  for (std::size_t i = 0; i < kPath; ++i) {
    casts.push_back(octomap_cast(view_poses()[i], fan_of(state.range(0))));
  }
  std::size_t unknown = 0;
  for (auto _ : state) {
    octomap::KeySet seen;
    for (const octomap::KeySet& cast : casts) seen.insert(cast.begin(), cast.end());
    benchmark::DoNotOptimize(unknown = seen.size());
  }
  state.counters["unknown"] = static_cast<double>(unknown);
}
BENCHMARK(octomap_view_union)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace canopeer
