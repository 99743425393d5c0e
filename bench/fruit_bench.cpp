// The fruit map's two costs: fitting one shape, and an update of a whole row after a frame.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "auto_diff_fit.h"
#include "bench_rows.h"
#include "canopeer/base/rng.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/render/renderer.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

// ---- One shape of 1 000 points, seen from one side: all starts are tried.

std::vector<SurfacePoint> seen_fruit(std::uint64_t seed) {
  Rng rng(seed);
  Superellipsoid body;
  body.semi_axes_m = {rng.uniform(0.030, 0.038), rng.uniform(0.028, 0.034),
                      rng.uniform(0.032, 0.044)};
  body.e1 = rng.uniform(0.6, 0.85);
  body.e2 = rng.uniform(0.6, 0.85);
  body.T_world_body.translation() = Vec3(0.8, rng.uniform(-1.0, 1.0), 1.0);
  body.T_world_body.linear() = rotation_of({0.1, -0.1, rng.uniform(-1.5, 1.5)});
  std::vector<SurfacePoint> points;
  for (SurfacePoint s : body.surface_samples(2200)) {
    if ((s.point - body.centre()).x() > 0.0 || points.size() == 1000) continue;
    s.point += rng.normal(0.0, 0.001) * s.normal;
    points.push_back(s);
  }
  return points;
}

constexpr int kFruits = 8;

const std::vector<std::vector<SurfacePoint>>& fruits() {
  static const auto kAll = [] {
    std::vector<std::vector<SurfacePoint>> all;
    for (int i = 0; i < kFruits; ++i) all.push_back(seen_fruit(static_cast<std::uint64_t>(i) + 1));
    return all;
  }();
  return kAll;
}

void fit(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_superellipsoid(fruits()[i++ % kFruits]));
  }
}

void auto_diff(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(testing_support::auto_diff_fit(fruits()[i++ % kFruits], {}));
  }
}

// ---- A row: frames along both rows of Scenario 1, all fused; then one frame more at a time.

struct Row {
  std::vector<RgbdFrame> first;  // what the map knows already
  std::vector<RgbdFrame> next;   // what comes
  std::vector<Mask> first_fruit;
  std::vector<Mask> next_fruit;
};

/// From the aisle at four heights, looking at the row; every next frame from a little beside.
const Row& row() {
  static const Row kRow = [] {
    Row r;
    const Scene scene = make_world(scenario_1_world(), 1);
    const Renderer renderer(scene);
    Rng rng(1);
    const auto shoot = [&](const Vec3& from, const Vec3& to, std::vector<RgbdFrame>& frames,
                           std::vector<Mask>& masks) {
      RgbdFrame frame;
      frame.intrinsics = CameraIntrinsics::from_fov(640, 480, 80.0 / 180.0 * M_PI);
      frame.T_world_camera = look_at(from, to);
      RenderedView view = renderer.render(frame.intrinsics, frame.T_world_camera);
      frame.depth = std::move(view.depth);
      frame.color = std::move(view.color);
      Mask fruit(640, 480, 0);
      for (std::size_t i = 0; i < fruit.pixels().size(); ++i) {
        const int id = view.labels.fruit.pixels()[i];
        if (id >= 0 && scene.fruits[static_cast<std::size_t>(id)].counted) fruit.pixels()[i] = 3;
      }
      frames.push_back(std::move(frame));
      masks.push_back(std::move(fruit));
    };
    for (const double side : {-1.0, 1.0}) {
      for (double y = -1.4; y < 1.5; y += 0.25) {
        for (const double z : {0.5, 0.9}) {
          const Vec3 from(0.2 * side, y, z + 0.15);
          const Vec3 to(0.8 * side, y, z);
          shoot(from, to, r.first, r.first_fruit);
          const Vec3 off(rng.uniform(-0.08, 0.08), rng.uniform(-0.15, 0.15),
                         rng.uniform(-0.1, 0.1));
          shoot(from + off, to, r.next, r.next_fruit);
        }
      }
    }
    return r;
  }();
  return kRow;
}

double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The 95th percentile of an update's CPU time over all frames that come; `all_anew`: every fruit
/// of the row is found and fitted anew after each frame.
void update_row(benchmark::State& state, bool all_anew, const FruitMapOptions& options = {}) {
  const Row& r = row();
  std::vector<double> times;
  std::size_t known = 0;
  for (auto _ : state) {
    FruitMap map(options);
    for (std::size_t i = 0; i < r.first.size(); ++i) {
      map.add(r.first[i], r.first_fruit[i]);
      map.update();
    }
    times.clear();
    for (std::size_t i = 0; i < r.next.size(); ++i) {
      const double begin = cpu_s();
      map.add(r.next[i], r.next_fruit[i]);
      all_anew ? map.update_all() : map.update();
      times.push_back(1e3 * (cpu_s() - begin));
    }
    known = map.fruits().size();
  }
  std::sort(times.begin(), times.end());
  state.counters["p95_ms"] = times[times.size() * 95 / 100];
  state.counters["median_ms"] = times[times.size() / 2];
  state.counters["fruits"] = static_cast<double>(known);
}

void update(benchmark::State& state) { update_row(state, false); }
void update_all(benchmark::State& state) { update_row(state, true); }

void update_unbounded(benchmark::State& state) {
  FruitMapOptions options;
  options.update_points = FruitMapOptions::kNoBound;
  update_row(state, false, options);
}

BENCHMARK(fit);
BENCHMARK(auto_diff);
BENCHMARK(update)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(update_unbounded)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(update_all)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  return canopeer::run_benchmarks(
      argc, argv,
      {{.name = "fruit.fit", .ours = "fit", .baseline = "auto_diff", .unit = "ms"},
       {.name = "fruit.update_p95",
        .ours = "update",
        .baseline = "update_all",
        .unit = "ms",
        .counter = "p95_ms"},
       {.name = "fruit.update_unbounded_p95",
        .ours = "update_unbounded",
        .baseline = "update_all",
        .unit = "ms",
        .counter = "p95_ms"}});
}
