#include "canopeer/sim/calibration.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/fusion.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/robot/motion_planner.h"
#include "canopeer/search/path_search.h"
#include "canopeer/viewgraph/graph_builder.h"

namespace canopeer {
namespace {

constexpr int kRepetitions = 3;
constexpr int kFrames = 6;  // the map a segment's middle looks like
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

/// One segment with a map and a graph in it, and the measurements one by one.
class Bench {
 public:
  Bench(const RobotModel& robot, const ArmIk& ik, const Scene& scene, const MissionOptions& mission,
        const Detector& detector, const SimulationOptions& options)
      : robot_(robot),
        ik_(ik),
        mission_(mission),
        detector_(detector),
        plan_(mission.segments.front()),
        home_(robot.home("side_" + std::to_string(plan_.side))),
        simulation_(robot, scene, home_, plan_.trolley, options),
        map_(mission.map),
        field_(field_options(), map_.resolution_m()),
        checker_(robot, plan_.trolley, mission.collision) {
    frame_.trolley = plan_.trolley;
    frame_.T_world_base = robot.T_world_base(plan_.trolley);
    frame_.workspace_base = robot.workspace(plan_.side);
    frame_.sampling_region_world =
        transformed(robot.sampling_region(plan_.side), frame_.T_world_base);
    frame_.home = home_;
    checker_.set_map(&field_);
  }

  /// Looks from home, then from views drawn at random; measures what a frame costs.
  void measure_frames(CostTable& costs) {
    Rng rng(1, "calibration views");
    std::vector<RgbdFrame> frames = {capture(home_)};
    take_in(frames.front());
    const ViewSampler sampler(frame_, robot_, ik_, mission_.planners.vmp.builder.sampler);
    TargetSampler targets = current_targets(sampler);
    WorkMeter work;
    for (int tries = 0; tries < 2000 && static_cast<int>(frames.size()) < kFrames; ++tries) {
      const auto view = sampler.sample(map_, checker_, targets, rng, work);
      if (!view) continue;
      frames.push_back(capture(view->q));
      take_in(frames.back());
      targets = current_targets(sampler);
    }
    costs[Work::detect_frame] = best_per_unit([&] {
      for (const auto& frame : frames) static_cast<void>(detector_.detect(frame));
      return frames.size();
    });
    costs[Work::fuse_point] = best_per_unit([&] {
      VoxelMap fresh(mission_.map);
      std::int64_t points = 0;
      for (const auto& f : frames) points += fuse(fresh, f, {}, mission_.fusion).fused_points;
      return points;
    });
    costs[Work::field_block] = field_seconds_per_block(frames);
    costs[Work::target_block] = best_per_unit([&] {
      static_cast<void>(extract_frontiers(map_, frame_.sampling_region_world));
      return map_.block_keys(frame_.sampling_region_world).size();
    });
  }

  void measure_sampling(CostTable& costs) {
    const ViewSampler sampler(frame_, robot_, ik_, mission_.planners.vmp.builder.sampler);
    const TargetSampler targets = current_targets(sampler);
    WorkMeter work;
    Rng rng(2, "calibration views");
    std::vector<ViewPose> views;
    const double begin_s = cpu_now_s();
    for (int i = 0; i < 400; ++i) {
      if (auto view = sampler.sample(map_, checker_, targets, rng, work)) {
        views.push_back(std::move(*view));
      }
    }
    const double sampling_s = cpu_now_s() - begin_s;
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
    // Most states are checked along edges.
    costs[Work::state_check] = best_per_unit([&] {
      int states = 0;
      for (std::size_t i = 0; i + 1 < count; ++i) {
        const Configuration next = robot_.endless().nearest(views[i + 1].q, views[i].q);
        static_cast<void>(checker_.edge_free(views[i].q, next, &states));
      }
      return states;
    });
    const double rest_s =
        sampling_s - static_cast<double>(work.units(Work::view_ik)) * costs[Work::view_ik] -
        static_cast<double>(work.units(Work::state_check)) * costs[Work::state_check];
    costs[Work::candidate] =
        std::max(0.0, rest_s) / static_cast<double>(work.units(Work::candidate));
    costs[Work::exact_state] = best_per_unit([&] {
      const std::size_t few = std::min<std::size_t>(count, 40);
      for (std::size_t i = 0; i < few; ++i) {
        static_cast<void>(simulation_.judge().checker().check(views[i].q, plan_.trolley, &map_));
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
    builder.set_targets(map_, extract_frontiers(map_, frame_.sampling_region_world), {});
    WorkMeter work;
    const NodeId start =
        builder.add_start(home_, checker_, frame_.T_world_base * robot_.T_base_camera(home_), work);
    while (!builder.resting() && graph.node_count() < kGraphNodes)
      builder.grow(map_, checker_, work);
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
    costs[Work::view_cast] = best_per_unit([&] {
      for (std::size_t i = 0; i < nodes; ++i) {
        ViewNode& node = graph.node(static_cast<NodeId>(i));
        if (!node.removed) node.cast = cast_view(map_, node.view.T_world_camera, fan);
      }
      return graph.node_count();
    });
    costs[Work::expansion] = best_per_unit([&] {
      WorkMeter search;
      static_cast<void>(search_path(graph, start, map_, mission_.planners.vmp.path_search, search));
      return search.units(Work::expansion);
    });
  }

 private:
  [[nodiscard]] DistanceFieldOptions field_options() const {
    DistanceFieldOptions around;
    const Vec3 reach = Vec3::Constant(mission_.field_reach_m);
    const Vec3 base = robot_.T_world_base(plan_.trolley).translation();
    around.world = Box(base - reach, base + reach);
    around.truncation_m = mission_.field_truncation_m;
    return around;
  }

  /// Bringing the blocks a frame changed into the field, without the fusing.
  [[nodiscard]] double field_seconds_per_block(const std::vector<RgbdFrame>& frames) const {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRepetitions; ++i) {
      VoxelMap map(mission_.map);
      DistanceField field(field_options(), map.resolution_m());
      double spent_s = 0.0;
      std::size_t blocks = 0;
      for (const auto& frame : frames) {
        const auto changed = fuse(map, frame, {}, mission_.fusion).changed;
        const double begin_s = cpu_now_s();
        field.update(map, changed);
        spent_s += cpu_now_s() - begin_s;
        blocks += changed.size();
      }
      if (blocks > 0) best = std::min(best, spent_s / static_cast<double>(blocks));
    }
    return best;
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
  void take_in(const RgbdFrame& frame) {
    const auto seen = detector_.detect(frame);
    CANOPEER_CHECK(seen.has_value(), "a detector that was made detects");
    field_.update(map_, fuse(map_, frame, seen->fruit, mission_.fusion).changed);
  }
  [[nodiscard]] TargetSampler current_targets(const ViewSampler& sampler) const {
    return sampler.targets_in_reach(extract_frontiers(map_, frame_.sampling_region_world),
                                    map_.resolution_m(), mission_.planners.vmp.builder.shares);
  }

  const RobotModel& robot_;
  const ArmIk& ik_;
  const MissionOptions& mission_;
  const Detector& detector_;
  SegmentPlan plan_;
  Configuration home_;
  Simulation simulation_;
  VoxelMap map_;
  DistanceField field_;
  CollisionChecker checker_;
  SegmentFrame frame_;
};

}  // namespace

CostTable measure_costs(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                        const MissionOptions& mission, const Detector& detector,
                        const SimulationOptions& simulation,
                        const std::function<void(std::string_view)>& progress) {
  // The cost table counts one core's seconds.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CostTable costs;
  Bench bench(robot, ik, scene, mission, detector, simulation);
  progress("frames: detecting, fusing, distances, targets");
  bench.measure_frames(costs);
  progress("views: sampling, kinematics, collisions, motions");
  bench.measure_sampling(costs);
  progress("graph: neighbours, view casts, search");
  bench.measure_search(costs);
  return costs;
}

}  // namespace canopeer
