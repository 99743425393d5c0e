// The map's kernels beside OctoMap doing the same job in the same program, on one thread: a 2 m
// row of leaves and fruit (small balls) in front of a wall, 1 cm voxels, 640 × 480 depth images.

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>
#include <tbb/global_control.h>

#include <cmath>
#include <ctime>
#include <optional>
#include <vector>

#include "ball_scene.h"
#include "bench_rows.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/frontier_index.h"
#include "canopeer/map/fusion.h"
#include "canopeer/map/map_snapshots.h"
#include "canopeer/map/view_cast.h"

namespace canopeer {
namespace {

constexpr double kResolution = 0.01;
constexpr int kViews = 6;
const CameraIntrinsics kCamera = CameraIntrinsics::from_fov(640, 480, 1.396);
const Box kSamplingRegion(Vec3(0.3, -1.0, -0.6), Vec3(1.3, 1.0, 0.6));

const std::vector<BallScene::View>& views() {
  static const std::vector<BallScene::View> all = [] {
    BallScene scene = BallScene::random(1, 300);
    scene.wall_x = 2.5;
    Rng rng(1, "bench cameras");
    std::vector<BallScene::View> rendered;
    for (int i = 0; i < kViews; ++i) {
      rendered.push_back(scene.render(BallScene::random_camera(rng), kCamera));
    }
    return rendered;
  }();
  return all;
}

// Poses for view queries: many, so that no view finds the caches as it left them.
const std::vector<Pose>& view_poses() {
  static const std::vector<Pose> all = [] {
    Rng rng(1, "bench views");
    std::vector<Pose> poses;
    for (int i = 0; i < 100; ++i) poses.push_back(BallScene::random_camera(rng));
    return poses;
  }();
  return all;
}

const VoxelMap& fused_map() {
  static const VoxelMap map = [] {
    VoxelMap fused;
    for (int i = 0; i + 1 < kViews; ++i) fuse(fused, views()[i].frame, views()[i].roi);
    return fused;
  }();
  return map;
}

octomap::point3d point(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

octomap::Pointcloud cloud_of(const RgbdFrame& frame) {
  octomap::Pointcloud cloud;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const double depth = static_cast<double>(frame.depth.at(u, v));
      if (std::isfinite(depth)) {
        cloud.push_back(point(frame.T_world_camera * (depth * kCamera.ray(u, v))));
      }
    }
  }
  return cloud;
}

// The same map as an octree (values copied, so that queries see the same world).
const octomap::OcTree& fused_octree() {
  static const octomap::OcTree tree = [] {
    octomap::OcTree copy(kResolution);
    for (const BlockKey key : fused_map().block_keys()) {
      for_each_voxel(key, fused_map().block(key)->observed, [&](const VoxelIndex& v) {
        copy.setNodeValue(point(voxel_centre(v, kResolution)),
                          static_cast<float>(fused_map().occupancy_log_odds(v)), true);
      });
    }
    copy.updateInnerOccupancy();
    return copy;
  }();
  return tree;
}

ViewFan fan_of(std::int64_t rays) {
  ViewFan fan;
  fan.columns = rays == 63 ? 9 : rays == 192 ? 16 : 40;
  fan.rows = rays == 63 ? 7 : rays == 192 ? 12 : 30;
  return fan;
}

double thread_cpu_ms() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// One thread, unless a benchmark takes more for itself.
class Threads {
 public:
  explicit Threads(std::size_t count) { limit().emplace(kParallelism, count); }
  ~Threads() { limit().emplace(kParallelism, 1); }

 private:
  static constexpr auto kParallelism = tbb::global_control::max_allowed_parallelism;
  static std::optional<tbb::global_control>& limit() {
    static std::optional<tbb::global_control> value;
    return value;
  }
};

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

// CPU time is the calling thread's, so this is what remains for it when a second one helps.
void fuse_new_two_threads(benchmark::State& state) {
  const Threads two(2);
  fuse_views(state, fuse, resolution(kResolution));
}
BENCHMARK(fuse_new_two_threads)->Unit(benchmark::kMillisecond)->Iterations(6 * kViews);

void fuse_exact_new(benchmark::State& state) {
  fuse_views(state, fuse_exact, resolution(kResolution));
}
BENCHMARK(fuse_exact_new)->Unit(benchmark::kMillisecond)->Iterations(kViews);

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

// The views again every metre of a 50 m row.
void row_50m(benchmark::State& state) {
  constexpr int kMetres = 50, kEnd = 5;
  for (auto _ : state) {
    VoxelMap map;
    double first_ms = 0.0, last_ms = 0.0;
    for (int metre = 0; metre < kMetres; ++metre) {
      for (const BallScene::View& view : views()) {
        RgbdFrame frame = view.frame;
        frame.T_world_camera.translation().y() += metre;
        const double start_ms = thread_cpu_ms();
        fuse(map, frame, view.roi);
        const double ms = (thread_cpu_ms() - start_ms) / (kEnd * kViews);
        if (metre >= kEnd && metre < 2 * kEnd) first_ms += ms;
        if (metre >= kMetres - kEnd) last_ms += ms;
      }
    }
    MapSnapshots snapshots;
    const double start_ms = thread_cpu_ms();
    snapshots.publish(map);
    state.counters["snapshot_us"] = (thread_cpu_ms() - start_ms) * 1e3;
    state.counters["first_ms"] = first_ms;
    state.counters["last_ms"] = last_ms;
    state.counters["growth"] = last_ms / first_ms;
    state.counters["MB"] = static_cast<double>(map.memory_bytes()) / 1e6;
    state.counters["m3"] = static_cast<double>(map.observed_voxels()) * std::pow(kResolution, 3);
  }
}
BENCHMARK(row_50m)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(1);

void octomap_fuse(benchmark::State& state) {
  octomap::OcTree tree(kResolution);
  const octomap::Pointcloud cloud = cloud_of(views()[0].frame);
  for (auto _ : state) {
    tree.insertPointCloud(cloud, point(views()[0].frame.T_world_camera.translation()), 3.0);
  }
}
BENCHMARK(octomap_fuse)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(1);

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

// As the reference does it: the keys of each ray up to the first occupied voxel, unknown ones into
// one KeySet.
octomap::KeySet octomap_cast(const Pose& T_world_camera, const ViewFan& fan) {
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
          break;
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

// The union of the sets along a path of ten views.
constexpr std::size_t kPath = 10;

void view_union(benchmark::State& state) {
  std::vector<ViewCast> casts;
  for (std::size_t i = 0; i < kPath; ++i) {
    casts.push_back(cast_view(fused_map(), view_poses()[i], fan_of(state.range(0))));
  }
  for (auto _ : state) {
    VoxelSet seen;
    for (const ViewCast& cast : casts) seen.merge(cast.unknown);
    benchmark::DoNotOptimize(seen.count());
    state.counters["unknown"] = static_cast<double>(seen.count());
  }
}
BENCHMARK(view_union)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

void octomap_view_union(benchmark::State& state) {
  std::vector<octomap::KeySet> casts;
  for (std::size_t i = 0; i < kPath; ++i) {
    casts.push_back(octomap_cast(view_poses()[i], fan_of(state.range(0))));
  }
  for (auto _ : state) {
    octomap::KeySet seen;
    for (const octomap::KeySet& cast : casts) seen.insert(cast.begin(), cast.end());
    benchmark::DoNotOptimize(seen.size());
    state.counters["unknown"] = static_cast<double>(seen.size());
  }
}
BENCHMARK(octomap_view_union)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

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

int main(int argc, char** argv) {
  { const canopeer::Threads one(1); }  // and one thread it stays
  canopeer::fused_map();               // the scene is made before anything is timed
  canopeer::fused_octree();
  const auto row = [](const char* name, const char* ours, const char* baseline, const char* unit) {
    canopeer::BenchRow r;
    r.name = name;
    r.ours = ours;
    r.baseline = baseline;
    r.unit = unit;
    return r;
  };
  const auto counter = [&](const char* name, const char* ours, const char* baseline,
                           const char* unit, const char* which) {
    canopeer::BenchRow r = row(name, ours, baseline, unit);
    r.counter = which;
    return r;
  };
  canopeer::BenchRow update_all = row("map.update_all", "update_all", "", "ms");
  update_all.stated = 33.0;  // a frame of a 30 Hz camera
  return canopeer::run_benchmarks(
      argc, argv,
      {row("map.fuse_projective", "fuse_new", "octomap_fuse", "ms"),
       row("map.fuse_projective_scalar", "fuse_new_scalar", "octomap_fuse", "ms"),
       row("map.fuse_projective_2_threads", "fuse_new_two_threads", "fuse_new", "ms"),
       row("map.fuse_projective_again", "fuse_again", "octomap_fuse", "ms"),
       row("map.fuse_projective_5mm", "fuse_new_5mm", "", "ms"),
       row("map.fuse_exact", "fuse_exact_new", "octomap_fuse", "ms"), update_all,
       row("map.view_63", "view_cast/63", "octomap_view_cast/63", "us"),
       row("map.view_192", "view_cast/192", "octomap_view_cast/192", "us"),
       row("map.view_1200", "view_cast/1200", "octomap_view_cast/1200", "us"),
       row("map.union_10", "view_union/63", "octomap_view_union/63", "us"),
       row("map.union_10_1200", "view_union/1200", "octomap_view_union/1200", "us"),
       row("map.frontiers", "frontiers", "octomap_frontiers", "us"),
       counter("map.memory", "memory", "octomap_memory", "MB", "MB"),
       counter("map.row_50m_frame_time_growth", "row_50m", "", "x", "growth"),
       counter("map.row_50m_memory", "row_50m", "", "MB", "MB"),
       counter("map.row_50m_snapshot", "row_50m", "", "us", "snapshot_us")});
}
