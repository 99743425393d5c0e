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

Box ViewSampler::part_in_reach(const Vec3& target_world) const {
  const Vec3 reach = Vec3::Constant(options_.max_target_distance_m);
  const Vec3 target_base = T_base_world_ * target_world;
  return frame_->workspace_base.intersection(Box(target_base - reach, target_base + reach));
}

TargetSampler ViewSampler::targets_in_reach(const FrontierTargets& frontiers, double resolution_m,
                                            const TargetShares& shares) const {
  return {frontiers, resolution_m, shares, [this](const Vec3& target_world) {
            const Box part = part_in_reach(target_world);
            return part.isEmpty() ? 0.0 : part.volume();
          }};
}

// Target and position uniform, given that they are within the distances: targets come with a chance
// in proportion to the part of the workspace in the box around their reach, and a position drawn in
// that part is kept when it is in reach.
std::optional<ViewSampler::Sight> ViewSampler::draw_sight(const TargetSampler& targets,
                                                          TargetKind kind, Rng& rng) const {
  const double nearest2 = options_.min_target_distance_m * options_.min_target_distance_m;
  const double farthest2 = options_.max_target_distance_m * options_.max_target_distance_m;
  for (int i = 0; i < options_.max_draws; ++i) {
    const Target target = targets.draw(kind, rng);
    const Box part = part_in_reach(target.p_world);
    if (part.isEmpty()) continue;
    Vec3 camera_base;
    for (const int axis : {2, 1, 0}) {
      camera_base[axis] = rng.uniform(part.min()[axis], part.max()[axis]);
    }
    const double distance2 = (camera_base - T_base_world_ * target.p_world).squaredNorm();
    if (distance2 >= nearest2 && distance2 <= farthest2) {
      return Sight{target, frame_->T_world_base * camera_base};
    }
  }
  return std::nullopt;
}

std::optional<Configuration> ViewSampler::reach(const Sight& sight, const CollisionChecker& checker,
                                                WorkMeter& work) const {
  work.add(Work::view_ik);
  thread_local std::vector<Configuration> solutions;  // keeps its room from call to call
  ik_->solve_view(T_base_world_ * sight.camera_world, T_base_world_ * sight.target.p_world,
                  frame_->home, solutions, {options_.rolls});
  int checks = 0;
  for (const auto& q : solutions) {
    if (checks++ == options_.max_state_checks) break;
    work.add(Work::state_check);
    if (checker.state_free(q)) return q;
  }
  return std::nullopt;
}

}  // namespace canopeer
