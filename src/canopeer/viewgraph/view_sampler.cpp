#include "canopeer/viewgraph/view_sampler.h"

#include <vector>

#include "canopeer/map/view_cast.h"

namespace canopeer {

ViewSampler::ViewSampler(const SegmentFrame& frame, const RobotModel& robot, const ArmIk& ik,
                         const ViewSamplerOptions& options)
    : frame_(&frame),
      robot_(&robot),
      ik_(&ik),
      options_(options),
      T_base_world_(frame.T_world_base.inverse()) {}

std::optional<ViewPose> ViewSampler::sample(const VoxelMap& map, const CollisionChecker& checker,
                                            const TargetSampler& targets, Rng& rng,
                                            WorkMeter& work) const {
  const auto kind = targets.draw_kind(rng);
  if (!kind) return std::nullopt;
  for (int i = 0; i < options_.max_tries; ++i) {
    if (auto view = sample_once(map, checker, targets, *kind, rng, work)) return view;
  }
  return std::nullopt;
}

std::optional<ViewPose> ViewSampler::sample_once(const VoxelMap& map,
                                                 const CollisionChecker& checker,
                                                 const TargetSampler& targets, TargetKind kind,
                                                 Rng& rng, WorkMeter& work) const {
  work.add(Work::candidate);
  const auto sight = draw_sight(targets, kind, rng);
  if (!sight) return std::nullopt;
  if (ray_blocked(map, sight->target.p_world, sight->camera_world)) return std::nullopt;
  auto q = reach(*sight, checker, work);
  if (!q) return std::nullopt;
  ViewPose view;
  view.T_world_camera = frame_->T_world_base * robot_->T_base_camera(*q);
  view.q = std::move(*q);
  view.target_world = sight->target.p_world;
  view.kind = kind;
  return view;
}

std::optional<ViewSampler::Sight> ViewSampler::draw_sight(const TargetSampler& targets,
                                                          TargetKind kind, Rng& rng) const {
  const Box& box = frame_->workspace_base;
  for (int i = 0; i < options_.max_draws; ++i) {
    const Target target = targets.draw(kind, rng);
    const Vec3 camera_base(rng.uniform(box.min().x(), box.max().x()),
                           rng.uniform(box.min().y(), box.max().y()),
                           rng.uniform(box.min().z(), box.max().z()));
    const Vec3 camera_world = frame_->T_world_base * camera_base;
    const double distance = (camera_world - target.p_world).norm();
    if (distance >= options_.min_target_distance_m && distance <= options_.max_target_distance_m) {
      return Sight{target, camera_world};
    }
  }
  return std::nullopt;
}

std::optional<Configuration> ViewSampler::reach(const Sight& sight, const CollisionChecker& checker,
                                                WorkMeter& work) const {
  work.add(Work::view_ik);
  std::vector<Configuration> solutions;
  ik_->solve_view(T_base_world_ * sight.camera_world, T_base_world_ * sight.target.p_world,
                  frame_->home, solutions, {options_.rolls});
  int checks = 0;
  for (auto& q : solutions) {
    if (checks++ == options_.max_state_checks) break;
    work.add(Work::state_check);
    if (checker.state_free(q)) return std::move(q);
  }
  return std::nullopt;
}

}  // namespace canopeer
