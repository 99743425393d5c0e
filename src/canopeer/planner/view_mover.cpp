#include "canopeer/planner/view_mover.h"

#include <utility>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr int kMaxStateChecks = 12;  // configurations of one view tried, as in view sampling

}  // namespace

ViewMover::ViewMover(const PlanningScene& scene, const MotionPlannerOptions& options)
    : scene_(scene),
      T_base_world_(scene.segment.T_world_base.inverse()),
      planner_(*scene.robot, options) {}

void ViewMover::moved(const PlanningScene& scene) {
  scene_ = scene;
  T_base_world_ = scene.segment.T_world_base.inverse();
}

std::optional<Configuration> ViewMover::reach(const Vec3& camera_world, const Vec3& target_world,
                                              const Configuration& near, WorkMeter& work) const {
  work.add(Work::view_ik);
  std::vector<Configuration> solutions;
  scene_.ik->solve_view(T_base_world_ * camera_world, T_base_world_ * target_world, near,
                        solutions);
  int checks = 0;
  for (auto& q : solutions) {
    if (checks++ == kMaxStateChecks) break;
    work.add(Work::state_check);
    if (scene_.checker->state_free(q)) return std::move(q);
  }
  return std::nullopt;
}

std::optional<Decision> ViewMover::go(const Configuration& from, const Configuration& to,
                                      TargetKind kind, WorkMeter& work) {
  const std::uint64_t stream = (static_cast<std::uint64_t>(scene_.segment.index) << 32) + plans_++;
  MotionPlanStats stats;
  auto way = planner_.plan(from, to, *scene_.checker,
                           Rng(scene_.seed, "single view", stream).bits(), &stats);
  work.add(Work::motion_plan, stats.states_checked);
  if (!way || way->size() < 2) return std::nullopt;
  Decision decision;
  decision.action = Decision::Action::move;
  decision.motion.T_world_camera =
      scene_.segment.T_world_base * scene_.robot->T_base_camera(way->back());
  decision.motion.kind = kind;
  decision.motion.waypoints = std::move(*way);
  return decision;
}

}  // namespace canopeer
