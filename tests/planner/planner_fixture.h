#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "canopeer/base/rng.h"
#include "canopeer/planner/registry.h"
#include "support/planning_fixture.h"

namespace canopeer::test {

/// What every built-in planner can be made with: those that need a file get one, in the directory
/// for temporary files.
inline PlannerOptions options_for_all() {
  const RobotModel& robot = test_robot();
  Rng rng(1, "views around home");
  ViewPlan plan;
  plan.segments.emplace_back();
  for (int view = 0; view < 12; ++view) {
    Configuration q = robot.home("side_1");
    for (Eigen::Index joint = 0; joint < q.size(); ++joint) q[joint] += rng.uniform(-0.05, 0.05);
    plan.segments[0].push_back(q);
  }
  PlannerOptions options;
  options.playback.plan =
      std::filesystem::temp_directory_path() / "canopeer_views_around_home.json";
  EXPECT_TRUE(write_view_plan(options.playback.plan, plan).has_value());
  return options;
}

/// A planner in a segment that has just begun: the shipped robot in front of Scenario 1.
class PlannerFixture {
 public:
  explicit PlannerFixture(std::unique_ptr<Planner> made) : planner(std::move(made)) {
    costs[Work::candidate] = 1e-4;
    planner->begin_segment(scene());
    planner->map_changed(world.home.change);
  }
  PlannerFixture(std::string_view name, const PlannerOptions& options)
      : PlannerFixture(std::move(*PlannerRegistry::built_in().make(name, options))) {}

  [[nodiscard]] PlanningScene scene() const {
    PlanningScene scene;
    scene.robot = &world.robot;
    scene.ik = &world.ik;
    scene.map = &world.perception.map();
    scene.checker = &world.checker;
    scene.judge = &world.simulation.judge().checker();
    scene.costs = &costs;
    scene.segment = world.frame;
    return scene;
  }

  /// Goes where the planner says and fuses what is seen there; false when it does not want to move.
  bool take_view() {
    for (int i = 0; i < 200; ++i) {
      last = planner->decide(q, work);
      if (last.action != Decision::Action::wait) break;
      planner->grow(0.05, work);
    }
    if (last.action != Decision::Action::move) return false;
    EXPECT_TRUE(ports.arm->start({last.motion.waypoints}).has_value());
    EXPECT_TRUE(ports.arm->finish().has_value());
    q = ports.arm->configuration();
    look();
    return true;
  }

  /// A frame from where the arm is, fused and told to the planner.
  void look() {
    StageTimer timer;
    auto seen = world.perception.observe(ports.camera->capture().value(),
                                         world.frame.sampling_region_world, work, timer);
    ASSERT_TRUE(seen.has_value());
    planner->map_changed(std::move(seen->change));
  }

  PlanningFixture world;
  Ports ports = world.simulation.ports();  ///< the simulation's, until a test puts faults between
  CostTable costs;
  WorkMeter work;
  std::unique_ptr<Planner> planner;
  Configuration q = world.frame.home;
  Decision last;
};

}  // namespace canopeer::test
