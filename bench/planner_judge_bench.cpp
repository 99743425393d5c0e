// Judging motions in simulation: the judge of runs beside FCL on every state.

#include <benchmark/benchmark.h>

#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/fusion.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/scene/worlds.h"
#include "canopeer/sim/simulation.h"
#include "support/plain_judge.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

/// A stop of a world after four frames, and motions there that a planner holds to be free.
struct JudgedStop {
  explicit JudgedStop(const WorldOptions& world)
      : scene(make_world(world, 1)), judge(robot, scene), plain(robot, scene, trolley) {
    Rng rng(1, "judged motions");
    Simulation simulation(robot, scene, home, trolley, {});
    const Ports ports = simulation.ports();
    for (int frames = 0; frames < 4;) {
      const Configuration q = around_home(rng);
      if (!CollisionChecker(robot, trolley).state_free(q)) continue;
      static_cast<void>(ports.arm->start({{ports.arm->configuration(), q}}).value());
      static_cast<void>(ports.arm->finish().value());
      fuse(map, ports.camera->capture().value(), {}, {});
      ++frames;
    }
    DistanceFieldOptions around;
    const Vec3 base = robot.T_world_base(trolley).translation();
    around.world = Box(base - Vec3::Constant(1.2), base + Vec3::Constant(1.2));
    DistanceField field(around, map.resolution_m());
    field.rebuild(map);
    CollisionChecker checker(robot, trolley);
    checker.set_map(&field);
    Configuration at = home;
    while (motions.size() < 40) {
      const Configuration next = around_home(rng);
      if (!checker.edge_free(at, next)) continue;
      motions.push_back({at, next});
      at = next;
    }
  }

  [[nodiscard]] Configuration around_home(Rng& rng) const {
    Configuration q = home;
    for (int i = 0; i < q.size(); ++i) q[i] += rng.uniform(-0.5, 0.5);
    return q;
  }

  const RobotModel& robot = test::test_robot();
  TrolleyState trolley{1.0, 0.0};
  Configuration home = robot.home("side_1");
  Scene scene;
  MotionJudge judge;
  test::PlainJudge plain;
  VoxelMap map;
  std::vector<std::vector<Configuration>> motions;
};

JudgedStop& scenario_stop() {
  static JudgedStop stop(scenario_1_world());
  return stop;
}

JudgedStop& dense_stop() {
  static JudgedStop stop(dense_1_world());
  return stop;
}

void judge_all(benchmark::State& state, JudgedStop& stop) {
  // What a stop costs once.
  static_cast<void>(stop.judge.judge(stop.motions.front(), stop.trolley, &stop.map));
  for (auto _ : state) {
    for (const auto& motion : stop.motions)
      benchmark::DoNotOptimize(stop.judge.judge(motion, stop.trolley, &stop.map));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stop.motions.size()));
}

void judge_all_plainly(benchmark::State& state, JudgedStop& stop) {
  for (auto _ : state) {
    for (const auto& motion : stop.motions)
      benchmark::DoNotOptimize(stop.plain.judge(motion, &stop.map));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stop.motions.size()));
}

void judge_scenario_1(benchmark::State& state) { judge_all(state, scenario_stop()); }
void judge_scenario_1_plain(benchmark::State& state) { judge_all_plainly(state, scenario_stop()); }
void judge_dense_1(benchmark::State& state) { judge_all(state, dense_stop()); }
void judge_dense_1_plain(benchmark::State& state) { judge_all_plainly(state, dense_stop()); }
/// Once a stop: all that is near becomes cells and distances.
void judge_stop(benchmark::State& state) {
  JudgedStop& stop = dense_stop();
  for (auto _ : state) {
    const MotionJudge judge(stop.robot, stop.scene);
    benchmark::DoNotOptimize(judge.judge({stop.home}, stop.trolley, &stop.map));
  }
}
/// What it was before: trees of triangles for FCL.
void judge_stop_plain(benchmark::State& state) {
  const JudgedStop& stop = dense_stop();
  for (auto _ : state) {
    const test::PlainJudge judge(stop.robot, stop.scene, stop.trolley);
    benchmark::DoNotOptimize(judge.judge({stop.home}, &stop.map));
  }
}
BENCHMARK(judge_scenario_1)->Unit(benchmark::kMillisecond);
BENCHMARK(judge_scenario_1_plain)->Unit(benchmark::kMillisecond);
BENCHMARK(judge_dense_1)->Unit(benchmark::kMillisecond);
BENCHMARK(judge_dense_1_plain)->Unit(benchmark::kMillisecond);
BENCHMARK(judge_stop)->Unit(benchmark::kMillisecond);
BENCHMARK(judge_stop_plain)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace canopeer
