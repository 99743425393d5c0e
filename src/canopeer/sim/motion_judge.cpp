#include "canopeer/sim/motion_judge.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

// No point of an arm in use here is farther than this from a joint axis, so |Δq| rad move it at
// most this times |Δq|.
constexpr double kReach = 1.3;

std::vector<TriangleMesh> meshes(const Scene& scene, bool structure) {
  std::vector<TriangleMesh> found;
  for (const auto& part : scene.parts) {
    if (part.static_structure() == structure) found.push_back(part.mesh);
  }
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
      checker_(robot, meshes(scene, true)),
      plants_(meshes(scene, false)) {}

Verdict MotionJudge::judge(const std::vector<Configuration>& waypoints, const TrolleyState& trolley,
                           const VoxelMap* map) const {
  const auto states = states_along(waypoints, step_rad_);
  std::vector<Verdict> verdicts(states.size());
  tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t i) {
    verdicts[i].collision = checker_.check(states[i], trolley, map).any();
    verdicts[i].plant_contact = checker_.touches(states[i], trolley, plants_);
  });
  Verdict verdict;
  for (const auto& v : verdicts) {
    verdict.collision |= v.collision;
    verdict.plant_contact |= v.plant_contact;
  }
  return verdict;
}

}  // namespace canopeer
