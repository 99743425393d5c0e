// Rendering beside Embree's own throughput for the same rays, and a long row's time and memory. One
// thread. The worlds are those of the missions, seed 1; the views look at either row from the
// aisle.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <string>

#include "bench_rows.h"
#include "canopeer/render/rays/embree.h"
#include "canopeer/render/renderer.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

const CameraIntrinsics kCamera =
    CameraIntrinsics::from_fov(640, 480, 80.0 / 180.0 * 3.14159265358979323846);

/// As at the home states of the paper's arm, both sides, and from above at the second lift height.
std::vector<Pose> views() {
  std::vector<Pose> poses;
  for (const double y : {-1.0, 0.2, 1.0}) {
    for (const double side : {-1.0, 1.0}) {
      for (const double z : {0.78, 1.48}) {
        poses.push_back(look_at(Vec3(-0.12 * side, y, z), Vec3(0.75 * side, y, z - 0.1)));
      }
    }
  }
  return poses;
}

const Scene& world(const std::string& name) {
  static std::map<std::string, Scene> worlds;
  const auto known = worlds.find(name);
  if (known != worlds.end()) return known->second;
  return worlds.emplace(name, make_world(*named_world(name), 1)).first->second;
}

const Renderer& renderer(const std::string& name) {
  static std::map<std::string, Renderer> renderers;
  const auto known = renderers.find(name);
  if (known != renderers.end()) return known->second;
  return renderers.emplace(name, Renderer(world(name))).first->second;
}

void render(benchmark::State& state, const std::string& name) {
  const Renderer& r = renderer(name);
  const std::vector<Pose> poses = views();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(r.render(kCamera, poses[i]).depth.pixels().data());
    i = (i + 1) % poses.size();
  }
}

/// All triangles of a world in one Embree scene, copies where they stand.
class EmbreeWorld {
 public:
  EmbreeWorld(const Scene& scene, const char* config) : device_(rtcNewDevice(config)) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const auto& v : part.mesh.vertices) {
        vertices.emplace_back((T * v.cast<double>()).cast<float>());
      }
      for (const auto& t : part.mesh.triangles) {
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
      }
    });
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        sizeof vertices[0], vertices.size()),
                vertices.data(), vertices.size() * sizeof vertices[0]);
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        sizeof triangles[0], triangles.size()),
                triangles.data(), triangles.size() * sizeof triangles[0]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeWorld() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeWorld(const EmbreeWorld&) = delete;
  EmbreeWorld& operator=(const EmbreeWorld&) = delete;
  [[nodiscard]] RTCScene scene() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

RTCRay ray_of(const Pose& pose, int u, int v) {
  const Eigen::Vector3f o = pose.translation().cast<float>();
  const Eigen::Vector3f d = (pose.linear() * kCamera.ray(u, v)).cast<float>();
  RTCRay r{};
  r.org_x = o.x();
  r.org_y = o.y();
  r.org_z = o.z();
  r.dir_x = d.x();
  r.dir_y = d.y();
  r.dir_z = d.z();
  r.tfar = std::numeric_limits<float>::infinity();
  r.mask = ~0U;
  return r;
}

/// The rays of a view in blocks of 8 × 8 pixels, ready for Embree 3's stream of single rays.
std::vector<RTCRayHit> stream_of(const Pose& pose) {
  std::vector<RTCRayHit> rays;
  for (int v = 0; v < kCamera.height; v += 8) {
    for (int u = 0; u < kCamera.width; u += 8) {
      for (int k = 0; k < 64; ++k) {
        RTCRayHit r{};
        r.ray = ray_of(pose, u + k % 8, v + k / 8);
        r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rays.push_back(r);
      }
    }
  }
  return rays;
}

/// The same in packets of eight, two rows of four.
std::vector<RTCRayHit8> packets_of(const Pose& pose) {
  const std::vector<RTCRayHit> rays = stream_of(pose);
  std::vector<RTCRayHit8> packets(rays.size() / 8);
  for (std::size_t block = 0; block < rays.size(); block += 64) {
    for (std::size_t k = 0; k < 64; ++k) {
      const std::size_t column = k % 8;
      const std::size_t row = k / 8;
      RTCRayHit8& p = packets[block / 8 + (row / 2) * 2 + column / 4];
      const std::size_t lane = (row % 2) * 4 + column % 4;
      const RTCRay& r = rays[block + k].ray;
      p.ray.org_x[lane] = r.org_x;
      p.ray.org_y[lane] = r.org_y;
      p.ray.org_z[lane] = r.org_z;
      p.ray.dir_x[lane] = r.dir_x;
      p.ray.dir_y[lane] = r.dir_y;
      p.ray.dir_z[lane] = r.dir_z;
      p.ray.tnear[lane] = 0.0F;
      p.ray.time[lane] = 0.0F;
      p.ray.tfar[lane] = r.tfar;
      p.ray.mask[lane] = r.mask;
      p.ray.id[lane] = 0;
      p.ray.flags[lane] = 0;
      p.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      p.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }
  return packets;
}

#if RTC_VERSION_MAJOR < 4
/// Embree alone: rays ready made, hits not looked at. Embree 4 has no streams: no such baseline.
void embree_stream(benchmark::State& state, const std::string& name, const char* config) {
  const EmbreeWorld traced(world(name), config);
  std::vector<std::vector<RTCRayHit>> ready;
  for (const Pose& pose : views()) ready.push_back(stream_of(pose));
  std::size_t i = 0;
  std::vector<RTCRayHit> rays;
  for (auto _ : state) {
    state.PauseTiming();
    rays = ready[i];
    state.ResumeTiming();
    for (std::size_t block = 0; block < rays.size(); block += 64) {
      embree::closest_of_neighbors(traced.scene(), {rays.data() + block, 64});
    }
    i = (i + 1) % ready.size();
  }
}
#endif

void closest_of_eight(const int* valid, RTCScene scene, RTCRayHit8* packet) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, packet, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, packet);
#endif
}

/// The same in packets.
void embree_packets(benchmark::State& state, const std::string& name, const char* config) {
  const EmbreeWorld traced(world(name), config);
  std::vector<std::vector<RTCRayHit8>> ready;
  for (const Pose& pose : views()) ready.push_back(packets_of(pose));
  std::size_t i = 0;
  std::vector<RTCRayHit8> packets;
  alignas(32) const int all[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  for (auto _ : state) {
    state.PauseTiming();
    packets = ready[i];
    state.ResumeTiming();
    for (RTCRayHit8& p : packets) closest_of_eight(all, traced.scene(), &p);
    i = (i + 1) % ready.size();
  }
}

/// Memory the process has in use, MB.
double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  statm >> total >> resident;
  return resident * 4096.0 / 1048576.0;
}

void build_row_100m(benchmark::State& state) {
  const double before = resident_mb();
  double used = 0.0;
  for (auto _ : state) {
    const Scene scene = make_world(row_100m_world(), 1);
    const Renderer r(scene);
    used = resident_mb() - before;
  }
  state.counters["resident_mb"] = used;
}

void register_all() {
  benchmark::RegisterBenchmark("build_row_100m", build_row_100m)->Unit(benchmark::kMillisecond);
  for (const char* name : {"scenario_2", "dense_2", "row_100m"}) {
    const std::string world_name = name;
    const auto add = [&](const std::string& what, auto function) {
      benchmark::RegisterBenchmark((what + "/" + world_name).c_str(), function)
          ->Unit(benchmark::kMillisecond);
    };
    add("render", [=](benchmark::State& s) { render(s, world_name); });
    if (world_name == "row_100m") continue;
    add("embree_packets",
        [=](benchmark::State& s) { embree_packets(s, world_name, "isa=sse4.2,threads=1"); });
    add("embree_packets_widest",
        [=](benchmark::State& s) { embree_packets(s, world_name, "threads=1"); });
#if RTC_VERSION_MAJOR < 4
    add("embree_stream",
        [=](benchmark::State& s) { embree_stream(s, world_name, "isa=sse4.2,threads=1"); });
    add("embree_stream_widest",
        [=](benchmark::State& s) { embree_stream(s, world_name, "threads=1"); });
#endif
  }
}

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  canopeer::register_all();
  return canopeer::run_benchmarks(
      argc, argv,
      {{"scene.render", "render/scenario_2", "embree_stream/scenario_2", "ms"},
       {"scene.render_against_packets", "render/scenario_2", "embree_packets/scenario_2", "ms"},
       {"scene.render_dense_2", "render/dense_2", "embree_stream/dense_2", "ms"},
       {"scene.render_row_100m", "render/row_100m", "render/scenario_2", "ms"},
       {"scene.render_against_widest", "render/scenario_2", "embree_stream_widest/scenario_2",
        "ms"},
       {"scene.render_dense_2_against_widest", "render/dense_2", "embree_stream_widest/dense_2",
        "ms"},
       {"scene.build_row_100m", "build_row_100m", "", "s"},
       {"scene.memory_row_100m", "build_row_100m", "", "MB", "resident_mb"}});
}
