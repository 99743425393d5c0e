// Kinematics, collision checks and view sampling beside KDL and FCL in the same program, on one
// thread, with the map of Scenario 1 after five views.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolverpos_nr_jl.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>

#include "bench_rows.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/straight_timing.h"
#include "fcl_world.h"
#include "glasshouse.h"
#include "kdl_chain.h"

namespace canopeer {
namespace {

constexpr int kSights = 1024;
constexpr int kRestarts = 20;

double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const Glasshouse& ur5e() {
  static const Glasshouse world(CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml");
  return world;
}

const Glasshouse& rail() {
  static const Glasshouse world(CANOPEER_SOURCE_DIR "/robots/panda_rail/robot.yaml");
  return world;
}

std::vector<Configuration> random_configurations(const RobotModel& robot, int count) {
  Rng rng(1, "configurations");
  std::vector<Configuration> all;
  for (int k = 0; k < count; ++k) {
    Configuration q(robot.dof());
    for (int i = 0; i < q.size(); ++i)
      q[i] = rng.uniform(robot.span().lower[i], robot.span().upper[i]);
    all.push_back(q);
  }
  return all;
}

void fk(benchmark::State& state) {
  const RobotModel& robot = ur5e().robot;
  const auto qs = random_configurations(robot, 1024);
  std::vector<Pose> poses(robot.moving_links().size());
  std::size_t i = 0;
  for (auto _ : state) {
    robot.moving_link_poses(qs[i++ & 1023], Pose::Identity(), poses.data());
    benchmark::DoNotOptimize(poses.back().matrix().data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(fk);

void kdl_fk(benchmark::State& state) {
  const RobotModel& robot = ur5e().robot;
  const KDL::Chain chain =
      kdl_chain(robot.description(), robot.setup().base_link, robot.setup().camera_frame);
  KDL::ChainFkSolverPos_recursive kdl(chain);
  std::vector<KDL::JntArray> qs;
  for (const auto& q : random_configurations(robot, 1024)) qs.push_back(kdl_joints(q));
  std::vector<KDL::Frame> frames(chain.getNrOfSegments());
  std::size_t i = 0;
  for (auto _ : state) {
    kdl.JntToCart(qs[i++ & 1023], frames);
    benchmark::DoNotOptimize(frames.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(kdl_fk);

void count_views(benchmark::State& state, std::int64_t tried, std::int64_t solved) {
  state.SetItemsProcessed(solved);
  state.counters["solved_share"] = static_cast<double>(solved) / static_cast<double>(tried);
}

void view_ik(benchmark::State& state, const Glasshouse& world, const ArmIk& ik,
             const ViewIkOptions& options) {
  const auto sights = world.draw_sights(kSights, 1);
  std::vector<Configuration> found;
  std::int64_t tried = 0;
  std::int64_t solved = 0;
  for (auto _ : state) {
    const auto& sight = sights[static_cast<std::size_t>(tried++ % kSights)];
    ik.solve_view(sight.position_base, sight.target_base, world.frame.home, found, options);
    solved += found.empty() ? 0 : 1;
  }
  count_views(state, tried, solved);
}

ViewIkOptions one_solution() {
  ViewIkOptions options;
  options.numeric_solutions = 1;
  return options;
}

void ur5e_view_ik(benchmark::State& state) { view_ik(state, ur5e(), ur5e().ik, {}); }
BENCHMARK(ur5e_view_ik);
void rail_view_ik(benchmark::State& state) { view_ik(state, rail(), rail().ik, one_solution()); }
BENCHMARK(rail_view_ik);
void rail_view_ik_six_solutions(benchmark::State& state) { view_ik(state, rail(), rail().ik, {}); }
BENCHMARK(rail_view_ik_six_solutions);
void ur5e_numeric_view_ik(benchmark::State& state) {
  static const ArmIk numeric = *ArmIk::make_numeric(ur5e().robot);
  view_ik(state, ur5e(), numeric, one_solution());
}
BENCHMARK(ur5e_numeric_view_ik);

/// Fixed roll, random restarts, the first from home; a solution must keep the joint limits.
template <typename Solve>
void kdl_view_ik(benchmark::State& state, const Glasshouse& world, Solve&& solve) {
  const auto sights = world.draw_sights(kSights, 1);
  const auto starts = random_configurations(world.robot, 4096);
  KDL::JntArray out(static_cast<unsigned>(world.robot.dof()));
  std::int64_t tried = 0;
  std::int64_t solved = 0;
  std::size_t next_start = 0;
  for (auto _ : state) {
    const auto& sight = sights[static_cast<std::size_t>(tried++ % kSights)];
    const KDL::Frame goal = kdl_frame(look_at(sight.position_base, sight.target_base));
    for (int k = 0; k < kRestarts; ++k) {
      const Configuration& start = k == 0 ? world.frame.home : starts[next_start++ & 4095];
      if (!solve(kdl_joints(start), goal, out)) continue;
      Configuration q(world.robot.dof());
      for (int i = 0; i < q.size(); ++i) {
        q[i] = out(static_cast<unsigned>(i));
        if (world.robot.arm_joint_type(i) == JointType::kRevolute)
          q[i] = std::remainder(q[i], 2.0 * 3.14159265358979323846);
      }
      if (!world.robot.within_limits(q)) continue;
      ++solved;
      break;
    }
  }
  count_views(state, tried, solved);
}

void kdl_lma(benchmark::State& state, const Glasshouse& world) {
  const KDL::Chain chain = kdl_chain(world.robot.description(), world.robot.setup().base_link,
                                     world.robot.setup().camera_frame);
  KDL::ChainIkSolverPos_LMA lma(chain, 1e-6, 100);
  kdl_view_ik(state, world,
              [&](const KDL::JntArray& start, const KDL::Frame& goal, KDL::JntArray& out) {
                return lma.CartToJnt(start, goal, out) >= 0;
              });
}

void kdl_newton(benchmark::State& state, const Glasshouse& world) {
  const KDL::Chain chain = kdl_chain(world.robot.description(), world.robot.setup().base_link,
                                     world.robot.setup().camera_frame);
  KDL::ChainFkSolverPos_recursive forward(chain);
  KDL::ChainIkSolverVel_pinv velocity(chain);
  KDL::ChainIkSolverPos_NR_JL newton(chain, kdl_joints(world.robot.limits().lower),
                                     kdl_joints(world.robot.limits().upper), forward, velocity, 100,
                                     1e-6);
  kdl_view_ik(state, world,
              [&](const KDL::JntArray& start, const KDL::Frame& goal, KDL::JntArray& out) {
                return newton.CartToJnt(start, goal, out) >= 0;
              });
}

void kdl_lma_ur5e(benchmark::State& state) { kdl_lma(state, ur5e()); }
BENCHMARK(kdl_lma_ur5e)->Iterations(kSights);
void kdl_newton_ur5e(benchmark::State& state) { kdl_newton(state, ur5e()); }
BENCHMARK(kdl_newton_ur5e)->Iterations(kSights / 8);
void kdl_lma_rail(benchmark::State& state) { kdl_lma(state, rail()); }
BENCHMARK(kdl_lma_rail)->Iterations(kSights);
void kdl_newton_rail(benchmark::State& state) { kdl_newton(state, rail()); }
BENCHMARK(kdl_newton_rail)->Iterations(kSights / 8);

/// Valid view states: `check` is timed on each alone.
template <typename Check>
void state_check(benchmark::State& state, int repeats, Check&& check) {
  const Glasshouse& world = ur5e();
  std::vector<Configuration> states;
  for (const ViewPose& view : world.draw_views(600, 7)) states.push_back(view.q);
  std::vector<double> times;
  std::int64_t free = 0;
  for (auto _ : state) {
    times.clear();
    for (const Configuration& q : states) {
      bool result = false;
      const double start = cpu_time_s();
      for (int k = 0; k < repeats; ++k) benchmark::DoNotOptimize(result = check(q));
      times.push_back((cpu_time_s() - start) / repeats);
      free += result ? 1 : 0;
    }
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                   times.end());
  state.counters["median_us"] = times[times.size() / 2] * 1e6;
  state.counters["free_share"] = static_cast<double>(free) / static_cast<double>(states.size()) /
                                 static_cast<double>(state.iterations());
}

void state_check_median(benchmark::State& state) {
  state_check(state, 20, [](const Configuration& q) { return ur5e().checker.state_free(q); });
}
BENCHMARK(state_check_median);

void fcl_state_check_median(benchmark::State& state) {
  const Glasshouse& world = ur5e();
  static const FclWorld fcl(world.robot, world.frame.trolley, world.perception.map());
  state_check(state, 1, [](const Configuration& q) { return fcl.state_free(q); });
}
BENCHMARK(fcl_state_check_median);

void edge(benchmark::State& state) {
  const Glasshouse& world = ur5e();
  const auto edges = world.proposed_edges(300, 3);
  std::size_t i = 0;
  std::int64_t free = 0;
  int states = 0;
  double time_s = 0.0;
  for (auto _ : state) {
    const auto& [from, to] = edges[i++ % edges.size()];
    if (!world.checker.edge_free(from, to, &states)) continue;
    ++free;
    time_s += motion_time(from, to, world.robot.limits());
  }
  benchmark::DoNotOptimize(time_s);
  const auto count = static_cast<double>(state.iterations());
  state.counters["free_share"] = static_cast<double>(free) / count;
  state.counters["states_per_edge"] = states / count;
}
BENCHMARK(edge);

void view_poses(benchmark::State& state) {
  const Glasshouse& world = ur5e();
  const ViewSampler sampler(world.frame, world.robot, world.ik, {});
  const TargetSampler targets =
      sampler.targets_in_reach(world.targets, world.perception.map().resolution_m(), {});
  WorkMeter work;
  std::uint64_t i = 0;
  std::int64_t valid = 0;
  for (auto _ : state) {
    Rng rng(1, "view poses", i++);
    if (sampler.sample(world.perception.map(), world.checker, targets, rng, work)) ++valid;
  }
  state.SetItemsProcessed(valid);
  state.counters["tries_per_view"] =
      static_cast<double>(work.units(Work::candidate)) / static_cast<double>(valid);
  state.counters["checks_per_view"] =
      static_cast<double>(work.units(Work::state_check)) / static_cast<double>(valid);
}
BENCHMARK(view_poses);

ImageMotionLimit sharp_limit() { return {CameraIntrinsics(), 0.5, 2.0 / 0.005}; }

void path_timing(benchmark::State& state) {
  const RobotModel& robot = ur5e().robot;
  const auto qs = random_configurations(robot, 1024);
  std::size_t i = 0;
  for (auto _ : state) {
    const std::vector<Configuration> waypoints(
        qs.begin() + static_cast<std::ptrdiff_t>(i % 1000),
        qs.begin() + static_cast<std::ptrdiff_t>(i % 1000) + 5);
    ++i;
    benchmark::DoNotOptimize(PathMotion(waypoints, robot.limits()).duration_s());
  }
}
BENCHMARK(path_timing);

/// The same motions, no more than 2 px of blur in 5 ms at half a metre.
void timing_sharp(benchmark::State& state) {
  const RobotModel& robot = ur5e().robot;
  const auto qs = random_configurations(robot, 1024);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto from = qs.begin() + static_cast<std::ptrdiff_t>(i++ % 1000);
    const JointPath path{{from, from + 5}, std::vector<double>(5, 0.05), sharp_limit()};
    benchmark::DoNotOptimize(PathMotion(path, robot).duration_s());
  }
}
BENCHMARK(timing_sharp);

/// What the straight motion between two views of the graph takes, by the joints or sharp.
void edge_time_of(benchmark::State& state, const std::optional<ImageMotionLimit>& sharp) {
  const Glasshouse& world = ur5e();
  const auto edges = world.proposed_edges(300, 3);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [from, to] = edges[i++ % edges.size()];
    benchmark::DoNotOptimize(straight_motion_time(from, to, world.robot, sharp));
  }
}
void edge_time(benchmark::State& state) { edge_time_of(state, std::nullopt); }
BENCHMARK(edge_time);
void edge_time_sharp(benchmark::State& state) { edge_time_of(state, sharp_limit()); }
BENCHMARK(edge_time_sharp);

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  return canopeer::run_benchmarks(
      argc, argv,
      {{.name = "robot.fk", .ours = "fk", .baseline = "kdl_fk", .unit = "us"},
       {.name = "robot.view_ik_time", .ours = "ur5e_view_ik", .unit = "us"},
       {.name = "robot.view_ik", .ours = "ur5e_view_ik", .baseline = "kdl_lma_ur5e", .unit = "1/s"},
       {.name = "robot.view_ik_share",
        .ours = "ur5e_view_ik",
        .baseline = "kdl_lma_ur5e",
        .unit = "share",
        .counter = "solved_share",
        .more_is_better = true},
       {.name = "robot.view_ik_7dof",
        .ours = "rail_view_ik",
        .baseline = "kdl_lma_rail",
        .unit = "1/s"},
       {.name = "robot.view_ik_7dof_share",
        .ours = "rail_view_ik",
        .baseline = "kdl_lma_rail",
        .unit = "share",
        .counter = "solved_share",
        .more_is_better = true},
       {.name = "robot.state_check",
        .ours = "state_check_median",
        .baseline = "fcl_state_check_median",
        .unit = "us median",
        .counter = "median_us"},
       {.name = "robot.edge", .ours = "edge", .unit = "1/s", .stated = 500.0},
       {.name = "robot.view_poses", .ours = "view_poses", .unit = "1/s", .stated = 46.0},
       {.name = "robot.path_timing", .ours = "path_timing", .unit = "us"},
       {.name = "robot.timing_sharp",
        .ours = "timing_sharp",
        .baseline = "path_timing",
        .unit = "us"},
       {.name = "robot.edge_time_sharp",
        .ours = "edge_time_sharp",
        .baseline = "edge_time",
        .unit = "us"}});
}
