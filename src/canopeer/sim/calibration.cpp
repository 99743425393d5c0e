#include "canopeer/sim/calibration.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/mission/perception.h"
#include "canopeer/robot/motion_planner.h"
#include "canopeer/search/path_search.h"
#include "canopeer/viewgraph/graph_builder.h"

namespace canopeer {
namespace {

constexpr int kRepetitions = 3;
constexpr int kFrames = 20;  // the map a segment's end looks like
constexpr int kGraphNodes = 600;

double cpu_now_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Least seconds per unit of some repetitions; `work` returns how many units it did.
template <typename Work>
double best_per_unit(Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepetitions; ++i) {
    const double begin_s = cpu_now_s();
    const auto units = static_cast<double>(work());
    const double spent_s = cpu_now_s() - begin_s;
    if (units > 0) best = std::min(best, spent_s / units);
  }
  return std::isfinite(best) ? best : 0.0;
}

/// CPU time and units of one kind of work, added up.
struct Spent {
  double seconds = 0.0;
  std::int64_t units = 0;

  template <typename Step>
  auto time(const Step& step) {
    const double begin_s = cpu_now_s();
    auto result = step();
    seconds += cpu_now_s() - begin_s;
    return result;
  }
  [[nodiscard]] double per_unit() const {
    return units > 0 ? seconds / static_cast<double>(units) : 0.0;
  }
};

/// One segment with a map and a graph in it, and the measurements one by one.
class Bench {
 public:
  Bench(const RobotModel& robot, const ArmIk& ik, const Scene& scene, const MissionOptions& mission,
        const DetectorRegistry& detectors, const SimulationOptions& options)
      : robot_(robot),
        ik_(ik),
        mission_(mission),
        detectors_(detectors),
        plan_(mission.segments.front()),
        home_(robot.home("side_" + std::to_string(plan_.side))),
        simulation_(robot, scene, home_, plan_.trolley, options),
        perception_(mission, detectors),
        checker_(robot, plan_.trolley, mission.collision) {
    frame_.trolley = plan_.trolley;
    frame_.T_world_base = robot.T_world_base(plan_.trolley);
    frame_.workspace_base = robot.workspace(plan_.side);
    frame_.sampling_region_world =
        transformed(robot.sampling_region(plan_.side), frame_.T_world_base);
    frame_.home = home_;
    perception_.move_field(frame_.T_world_base.translation());
    checker_.set_map(&perception_.field());
  }

  /// Looks from home, then from views drawn at random; measures what a frame costs.
  void measure_frames(CostTable& costs) {
    Rng rng(1, "calibration views");
    std::vector<RgbdFrame> frames = {capture(home_)};
    see(perception_, frames.front());
    const ViewSampler sampler(frame_, robot_, ik_, mission_.planners.vmp.builder.sampler);
    TargetSampler targets = current_targets(sampler);
    WorkMeter work;
    for (int tries = 0; tries < 2000 && static_cast<int>(frames.size()) < kFrames; ++tries) {
      const auto view = sampler.sample(map(), checker_, targets, rng, work);
      if (!view) continue;
      frames.push_back(capture(view->q));
      see(perception_, frames.back());
      targets = current_targets(sampler);
    }
    constexpr std::array kKinds = {Work::detect_frame, Work::fuse_point, Work::field_block,
                                   Work::target_block, Work::fruit_frame};
    for (int i = 0; i < kRepetitions; ++i) {
      const FrameCosts spent = see_again(frames);
      for (const Work kind : kKinds) {
        const double s = spent[static_cast<std::size_t>(kind)].per_unit();
        costs[kind] = i == 0 ? s : std::min(costs[kind], s);
      }
    }
  }

  void measure_sampling(CostTable& costs) {
    const ViewSampler sampler(frame_, robot_, ik_, mission_.planners.vmp.builder.sampler);
    const TargetSampler targets = current_targets(sampler);
    WorkMeter work;
    std::vector<ViewPose> views;
    const double candidate_s = best_per_unit([&] {
      Rng rng(2, "calibration views");
      work = {};
      views.clear();
      for (int i = 0; i < 400; ++i) {
        if (auto view = sampler.sample(map(), checker_, targets, rng, work))
          views.push_back(std::move(*view));
      }
      return work.units(Work::candidate);
    });
    if (views.size() < 2) return;
    const auto count = views.size();
    std::vector<Configuration> solutions;
    costs[Work::view_ik] = best_per_unit([&] {
      for (const auto& view : views) {
        ik_.solve_view(robot_.T_base_camera(view.q).translation(),
                       frame_.T_world_base.inverse() * view.target_world, home_, solutions,
                       {mission_.planners.vmp.builder.sampler.rolls});
      }
      return count;
    });
    const double single_state_s = best_per_unit([&] {
      for (const auto& view : views) static_cast<void>(checker_.state_free(view.q));
      return count;
    });
    const auto per_candidate = [&](Work kind, double unit_s) {
      return static_cast<double>(work.units(kind)) * unit_s /
             static_cast<double>(work.units(Work::candidate));
    };
    costs[Work::candidate] =
        std::max(0.0, candidate_s - per_candidate(Work::view_ik, costs[Work::view_ik]) -
                          per_candidate(Work::state_check, single_state_s));
    costs[Work::exact_state] = best_per_unit([&] {
      const std::size_t few = std::min<std::size_t>(count, 40);
      for (std::size_t i = 0; i < few; ++i) {
        static_cast<void>(simulation_.judge().checker().check(views[i].q, plan_.trolley, &map()));
      }
      return few;
    });
    const MotionPlanner planner(robot_, mission_.motion);
    costs[Work::motion_plan] = best_per_unit([&] {
      MotionPlanStats stats;
      for (std::size_t i = 0; i < std::min<std::size_t>(count, 20); ++i) {
        static_cast<void>(planner.plan(home_, views[i].q, checker_, i, &stats));
      }
      return stats.states_checked;
    });
  }

  void measure_search(CostTable& costs) {
    ViewGraph graph;
    GraphBuilder builder(graph, frame_, robot_, ik_, mission_.planners.vmp.builder, 1);
    builder.set_targets(map(), extract_frontiers(map(), frame_.sampling_region_world), {});
    WorkMeter work;
    const NodeId start =
        builder.add_start(home_, checker_, frame_.T_world_base * robot_.T_base_camera(home_), work);
    while (!builder.resting() && graph.node_count() < kGraphNodes)
      builder.grow(map(), checker_, work);
    const ViewFan& fan = mission_.planners.vmp.path_search.fan;
    const auto nodes = static_cast<std::size_t>(graph.id_count());
    costs[Work::neighbor_search] = best_per_unit([&] {
      for (std::size_t i = 0; i < nodes; ++i) {
        const auto id = static_cast<NodeId>(i);
        static_cast<void>(graph.nearest(graph.node(id).view.q, 5, 2.0, id));
        static_cast<void>(graph.has_similar(graph.node(id).view, {}));
      }
      return nodes;
    });
    // Most states are checked along edges between neighbours.
    const GraphBuilderOptions& options = mission_.planners.vmp.builder;
    std::vector<std::pair<Configuration, Configuration>> edges;
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto id = static_cast<NodeId>(i);
      const Configuration& q = graph.node(id).view.q;
      const auto k = static_cast<std::size_t>(options.neighbors);
      for (const auto& near : graph.nearest(q, k, options.max_edge_distance_rad, id))
        edges.emplace_back(q, robot_.endless().nearest(graph.node(near.id).view.q, q));
    }
    costs[Work::state_check] = best_per_unit([&] {
      int states = 0;
      for (const auto& [a, b] : edges) static_cast<void>(checker_.edge_free(a, b, &states));
      return states;
    });
    costs[Work::view_cast] = best_per_unit([&] {
      for (std::size_t i = 0; i < nodes; ++i) {
        ViewNode& node = graph.node(static_cast<NodeId>(i));
        if (!node.removed) node.cast = cast_view(map(), node.view.T_world_camera, fan);
      }
      return graph.node_count();
    });
    costs[Work::expansion] = best_per_unit([&] {
      WorkMeter search;
      static_cast<void>(
          search_path(graph, start, map(), mission_.planners.vmp.path_search, search));
      return search.units(Work::expansion);
    });
  }

  /// What a plan takes beyond all other kinds of work in it.
  void measure_programs(CostTable& costs) {
    double best_s = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRepetitions; ++i) {
      const auto planner = PlannerRegistry::built_in().make("gomvp_recon", mission_.planners);
      CANOPEER_CHECK(planner.has_value(), "a planner of this library");
      (*planner)->begin_segment(planning_scene(costs));
      (*planner)->map_changed({{}, extract_frontiers(map(), frame_.sampling_region_world), {}});
      WorkMeter others;
      for (int k = 0; k < 100 && (*planner)->status().graph_nodes < kGraphNodes / 2; ++k)
        (*planner)->grow(0.1, others);
      WorkMeter work;
      const double begin_s = cpu_now_s();
      static_cast<void>((*planner)->decide(home_, work));
      const double spent_s = cpu_now_s() - begin_s - work.seconds(costs);
      const auto units = static_cast<double>(work.units(Work::simplex_row));
      if (units > 0) best_s = std::min(best_s, std::max(0.0, spent_s) / units);
    }
    costs[Work::simplex_row] = std::isfinite(best_s) ? best_s : 0.0;
  }

 private:
  using FrameCosts = std::array<Spent, kWorkKinds>;

  [[nodiscard]] const VoxelMap& map() const { return perception_.map(); }

  /// All steps of a frame, timed one by one, in the units that missions are charged for.
  void see(Perception& perception, const RgbdFrame& frame, FrameCosts& spent) const {
    const Box& region = frame_.sampling_region_world;
    const auto of = [&](Work kind) -> Spent& { return spent[static_cast<std::size_t>(kind)]; };
    const auto seen = of(Work::detect_frame).time([&] { return perception.detect(frame); });
    CANOPEER_CHECK(seen.has_value(), "a detector that was made detects");
    const FuseResult fused =
        of(Work::fuse_point).time([&] { return perception.fuse(frame, seen->fruit); });
    of(Work::field_block).time([&] { return perception.update_distances(fused.changed), 0; });
    of(Work::target_block).time([&] { return perception.update_targets(region, fused.changed); });
    of(Work::fruit_frame).time([&] { return perception.update_fruits(frame, seen->fruit), 0; });
    of(Work::detect_frame).units += 1;
    of(Work::fuse_point).units += fused.fused_points;
    of(Work::field_block).units += static_cast<std::int64_t>(fused.changed.size());
    of(Work::target_block).units +=
        static_cast<std::int64_t>(perception.map().block_keys(region).size());
    of(Work::fruit_frame).units += 1;
  }
  void see(Perception& perception, const RgbdFrame& frame) const {
    FrameCosts unused;
    see(perception, frame, unused);
  }

  /// What the frames cost one who has seen nothing yet.
  [[nodiscard]] FrameCosts see_again(const std::vector<RgbdFrame>& frames) const {
    Perception fresh(mission_, detectors_);
    fresh.move_field(frame_.T_world_base.translation());
    // The detector is made with the first frame.
    CANOPEER_CHECK(fresh.detect(frames.front()).has_value(), "a detector that was made detects");
    FrameCosts spent;
    for (const RgbdFrame& frame : frames) see(fresh, frame, spent);
    return spent;
  }

  [[nodiscard]] PlanningScene planning_scene(const CostTable& costs) const {
    PlanningScene scene;
    scene.robot = &robot_;
    scene.ik = &ik_;
    scene.map = &map();
    scene.checker = &checker_;
    scene.judge = &simulation_.judge().checker();
    scene.costs = &costs;
    scene.segment = frame_;
    return scene;
  }
  RgbdFrame capture(const Configuration& q) {
    const Ports ports = simulation_.ports();
    const auto started = ports.arm->start({{ports.arm->configuration(), q}});
    CANOPEER_CHECK(started.has_value() && ports.arm->finish().has_value(),
                   "a motion within limits");
    auto frame = ports.camera->capture();
    CANOPEER_CHECK(frame.has_value(), "the simulated camera always gives a frame");
    return std::move(*frame);
  }
  [[nodiscard]] TargetSampler current_targets(const ViewSampler& sampler) const {
    return sampler.targets_in_reach(extract_frontiers(map(), frame_.sampling_region_world),
                                    map().resolution_m(), mission_.planners.vmp.builder.shares);
  }

  const RobotModel& robot_;
  const ArmIk& ik_;
  const MissionOptions& mission_;
  const DetectorRegistry& detectors_;
  SegmentPlan plan_;
  Configuration home_;
  Simulation simulation_;
  Perception perception_;
  CollisionChecker checker_;
  SegmentFrame frame_;
};

}  // namespace

CostTable measure_costs(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                        const MissionOptions& mission, const DetectorRegistry& detectors,
                        const SimulationOptions& simulation,
                        const std::function<void(std::string_view)>& progress) {
  // The cost table counts one core's seconds.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CostTable costs;
  Bench bench(robot, ik, scene, mission, detectors, simulation);
  progress("frames: detecting, fusing, distances, targets, fruits");
  bench.measure_frames(costs);
  progress("views: sampling, kinematics, motions");
  bench.measure_sampling(costs);
  progress("graph: neighbours, collisions, view casts, search");
  bench.measure_search(costs);
  progress("integer programs");
  bench.measure_programs(costs);
  return costs;
}

}  // namespace canopeer
