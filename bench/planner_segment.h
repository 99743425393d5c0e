#pragma once

#include <memory>

#include "canopeer/map/frontier_index.h"
#include "canopeer/viewgraph/graph_builder.h"
#include "support/planning_fixture.h"

// Scenario 1, stop 1, side 1, 1 cm voxels: the world of the planner's benchmarks.

namespace canopeer {

/// A segment with a few frames fused.
class Segment {
 public:
  static constexpr int kFrames = 4;  // before anything is measured

  Segment() : targets_(world.home.change.targets) {
    Rng rng(1, "bench views");
    const ViewSampler sampler(world.frame, world.robot, world.ik, {});
    WorkMeter work;
    for (int taken = 0; taken < kFrames;) {
      const TargetSampler drawn =
          sampler.targets_in_reach(targets_, world.mission.map.resolution_m, {});
      const auto view = sampler.sample(world.perception.map(), world.checker, drawn, rng, work);
      if (!view) continue;
      look_from(view->q);
      ++taken;
    }
  }

  void look_from(const Configuration& q) {
    const Ports ports = world.simulation.ports();
    static_cast<void>(ports.arm->start({{ports.arm->configuration(), q}}).value());
    static_cast<void>(ports.arm->finish().value());
    targets_ = world.look().change.targets;
  }
  [[nodiscard]] const FrontierTargets& targets() const { return targets_; }
  [[nodiscard]] const VoxelMap& map() const { return world.perception.map(); }

  test::PlanningFixture world;

 private:
  FrontierTargets targets_;
};

inline Segment& segment() {
  static Segment one;
  return one;
}

/// A graph of as many nodes as it comes to, and its builder.
struct Built {
  ViewGraph graph;
  std::unique_ptr<GraphBuilder> builder;
  NodeId start{};

  explicit Built(int max_nodes) {
    GraphBuilderOptions options;
    options.max_nodes = max_nodes;
    auto& world = segment().world;
    builder = std::make_unique<GraphBuilder>(graph, world.frame, world.robot, world.ik, options, 7);
    builder->set_targets(segment().map(), segment().targets(), {});
    WorkMeter work;
    start = builder->add_start(
        world.frame.home, world.checker,
        world.frame.T_world_base * world.robot.T_base_camera(world.frame.home), work);
  }
  void grow() {
    WorkMeter work;
    builder->grow(segment().map(), segment().world.checker, work);
  }
};

}  // namespace canopeer
