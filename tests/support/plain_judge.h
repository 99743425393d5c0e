#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "canopeer/robot/arm_reach.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer::test {

/// What a MotionJudge says, found the plain way: FCL on every state, at one stop.
class PlainJudge {
 public:
  PlainJudge(const RobotModel& robot, const Scene& scene, const TrolleyState& trolley)
      : trolley_(trolley),
        checker_(robot, meshes(scene, true, Box())),
        plants_(meshes(scene, false, reach(robot, trolley))) {}

  [[nodiscard]] Verdict judge(const std::vector<Configuration>& waypoints,
                              const VoxelMap* map) const {
    const std::vector<Configuration> states = states_along(waypoints);
    std::vector<Verdict> verdicts(states.size());
    tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t i) {
      verdicts[i].collision = checker_.check(states[i], trolley_, map).any();
      verdicts[i].plant_contact = checker_.touches(states[i], trolley_, plants_);
    });
    Verdict verdict;
    for (const Verdict& v : verdicts) {
      verdict.collision |= v.collision;
      verdict.plant_contact |= v.plant_contact;
    }
    return verdict;
  }

 private:
  static Box reach(const RobotModel& robot, const TrolleyState& trolley) {
    const Vec3 base = robot.T_world_base(trolley).translation();
    const Vec3 far = Vec3::Constant(arm_reach_m(robot));
    return {base - far, base + far};
  }

  /// `box` empty: everywhere.
  static std::vector<TriangleMesh> meshes(const Scene& scene, bool structure, const Box& box) {
    std::vector<TriangleMesh> found;
    scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
      if (part.static_structure() != structure) return;
      if (!box.isEmpty() && !box.intersects(transformed(part.mesh.bounds(), T))) return;
      found.emplace_back();
      found.back().append(part.mesh, T);
    });
    return found;
  }

  static std::vector<Configuration> states_along(const std::vector<Configuration>& waypoints) {
    constexpr double kStepRad = 0.01 / 1.3;
    std::vector<Configuration> states;
    if (!waypoints.empty()) states.push_back(waypoints.front());
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      const Configuration delta = waypoints[i] - waypoints[i - 1];
      const int steps = std::max(1, static_cast<int>(std::ceil(delta.cwiseAbs().sum() / kStepRad)));
      for (int k = 1; k <= steps; ++k)
        states.push_back(waypoints[i - 1] + static_cast<double>(k) / steps * delta);
    }
    return states;
  }

  TrolleyState trolley_;
  ExactChecker checker_;
  MeshObstacles plants_;
};

}  // namespace canopeer::test
