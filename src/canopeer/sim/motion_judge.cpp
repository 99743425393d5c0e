#include "canopeer/sim/motion_judge.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "canopeer/robot/arm_reach.h"

namespace canopeer {
namespace {

// No point of an arm in use here is farther than this from a joint axis, so |Δq| rad move it at
// most this times |Δq|.
constexpr double kReach = 1.3;

std::vector<TriangleMesh> structure_of(const Scene& scene) {
  std::vector<TriangleMesh> found;
  for (const auto& part : scene.parts) {
    if (part.static_structure()) found.push_back(part.mesh);
  }
  return found;
}

/// What else is in the box, copies of models too.
std::vector<TriangleMesh> plants_in(const Scene& scene, const Box& box) {
  std::vector<TriangleMesh> found;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
    if (part.static_structure() || !box.intersects(transformed(part.mesh.bounds(), T))) return;
    if (copy == nullptr) {
      found.push_back(part.mesh);
    } else {
      found.emplace_back();
      found.back().append(part.mesh, T);
    }
  });
  return found;
}

std::vector<Configuration> states_along(const std::vector<Configuration>& waypoints, double step) {
  std::vector<Configuration> states;
  if (!waypoints.empty()) states.push_back(waypoints.front());
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Configuration delta = waypoints[i] - waypoints[i - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(delta.cwiseAbs().sum() / step)));
    for (int k = 1; k <= steps; ++k) {
      states.push_back(waypoints[i - 1] + static_cast<double>(k) / steps * delta);
    }
  }
  return states;
}

}  // namespace

MotionJudge::MotionJudge(const RobotModel& robot, const Scene& scene, double step_m)
    : step_rad_(step_m / kReach),
      robot_(robot),
      scene_(scene),
      checker_(robot, structure_of(scene)) {}

std::shared_ptr<const MotionJudge::Near> MotionJudge::plants_near(
    const TrolleyState& trolley) const {
  const std::scoped_lock lock(mutex_);
  if (near_ == nullptr || near_->trolley.travel_m != trolley.travel_m ||
      near_->trolley.lift_m != trolley.lift_m) {
    const Vec3 base = robot_.T_world_base(trolley).translation();
    const Vec3 reach = Vec3::Constant(arm_reach_m(robot_));
    near_ = std::make_shared<const Near>(
        Near{trolley, MeshObstacles(plants_in(scene_, Box(base - reach, base + reach)))});
  }
  return near_;
}

Verdict MotionJudge::judge(const std::vector<Configuration>& waypoints, const TrolleyState& trolley,
                           const VoxelMap* map) const {
  const auto states = states_along(waypoints, step_rad_);
  const std::shared_ptr<const Near> near = plants_near(trolley);
  std::vector<Verdict> verdicts(states.size());
  tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t i) {
    verdicts[i].collision = checker_.check(states[i], trolley, map).any();
    verdicts[i].plant_contact = checker_.touches(states[i], trolley, near->plants);
  });
  Verdict verdict;
  for (const auto& v : verdicts) {
    verdict.collision |= v.collision;
    verdict.plant_contact |= v.plant_contact;
  }
  return verdict;
}

}  // namespace canopeer
