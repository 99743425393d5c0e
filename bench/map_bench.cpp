// The map's kernels beside OctoMap doing the same job in the same program, on one thread: a 2 m
// row of leaves and fruit (small balls) in front of a wall, 1 cm voxels, 640 × 480 depth images.

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>
#include <tbb/global_control.h>

#include <cmath>
#include <vector>

#include "ball_scene.h"
#include "bench_rows.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/fusion.h"
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

void fuse_first(benchmark::State& state) {
  for (auto _ : state) {
    VoxelMap map;
    benchmark::DoNotOptimize(fuse(map, views()[0].frame, views()[0].roi).updated_voxels);
  }
}
BENCHMARK(fuse_first)->Unit(benchmark::kMillisecond);

void fuse_next(benchmark::State& state) {
  VoxelMap map = fused_map();
  std::int64_t voxels = 0;
  std::size_t frame = 0;
  for (auto _ : state) {
    const BallScene::View& view = views()[frame++ % kViews];
    voxels += fuse(map, view.frame, view.roi).updated_voxels;
  }
  state.counters["voxels"] =
      benchmark::Counter(static_cast<double>(voxels), benchmark::Counter::kAvgIterations);
  state.counters["map_MB"] = static_cast<double>(map.memory_bytes()) / 1e6;
}
BENCHMARK(fuse_next)->Unit(benchmark::kMillisecond);

void fuse_exact_next(benchmark::State& state) {
  VoxelMap map = fused_map();
  std::size_t frame = 0;
  for (auto _ : state) {
    const BallScene::View& view = views()[frame++ % kViews];
    benchmark::DoNotOptimize(fuse_exact(map, view.frame, view.roi).updated_voxels);
  }
}
BENCHMARK(fuse_exact_next)->Unit(benchmark::kMillisecond);

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
    unknown +=
        cast_view(fused_map(), views()[i++ % kViews].frame.T_world_camera, fan).unknown.count();
  }
  state.counters["unknown"] =
      benchmark::Counter(static_cast<double>(unknown), benchmark::Counter::kAvgIterations);
}
BENCHMARK(view_cast)->Arg(63)->Arg(192)->Arg(1200)->Unit(benchmark::kMicrosecond);

// As the reference does it: the keys of each ray up to the first occupied voxel, unknown ones into
// one KeySet.
void octomap_view_cast(benchmark::State& state) {
  const ViewFan fan = fan_of(state.range(0));
  const octomap::OcTree& tree = fused_octree();
  std::size_t unknown = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    const Pose& T_world_camera = views()[i++ % kViews].frame.T_world_camera;
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
    unknown += cells.size();
  }
  state.counters["unknown"] =
      benchmark::Counter(static_cast<double>(unknown), benchmark::Counter::kAvgIterations);
}
BENCHMARK(octomap_view_cast)->Arg(63)->Arg(192)->Arg(1200)->Unit(benchmark::kMicrosecond);

void view_union(benchmark::State& state) {
  std::vector<ViewCast> casts;
  for (const auto& view : views()) {
    casts.push_back(cast_view(fused_map(), view.frame.T_world_camera, fan_of(state.range(0))));
  }
  for (auto _ : state) {
    VoxelSet seen;
    for (const ViewCast& cast : casts) seen.merge(cast.unknown);
    benchmark::DoNotOptimize(seen.count());
  }
}
BENCHMARK(view_union)->Arg(63)->Arg(1200)->Unit(benchmark::kMicrosecond);

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
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  canopeer::fused_map();  // the scene is made before anything is timed
  return canopeer::run_benchmarks(argc, argv,
                                  {{.name = "map.fuse_projective",
                                    .ours = "fuse_next",
                                    .baseline = "octomap_fuse",
                                    .unit = "ms"},
                                   {.name = "map.fuse_exact",
                                    .ours = "fuse_exact_next",
                                    .baseline = "octomap_fuse",
                                    .unit = "ms"},
                                   {.name = "map.view_63",
                                    .ours = "view_cast/63",
                                    .baseline = "octomap_view_cast/63",
                                    .unit = "us"},
                                   {.name = "map.view_192",
                                    .ours = "view_cast/192",
                                    .baseline = "octomap_view_cast/192",
                                    .unit = "us"},
                                   {.name = "map.view_1200",
                                    .ours = "view_cast/1200",
                                    .baseline = "octomap_view_cast/1200",
                                    .unit = "us"},
                                   {.name = "map.frontiers",
                                    .ours = "frontiers",
                                    .baseline = "octomap_frontiers",
                                    .unit = "us"}});
}
