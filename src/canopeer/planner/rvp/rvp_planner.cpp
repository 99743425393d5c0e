#include "canopeer/planner/rvp/rvp_planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "canopeer/geometry/state_archive.h"
#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

Vec3 random_direction(Rng& rng) {
  const double z = rng.uniform(-1.0, 1.0);
  const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

RvpPlanner::RvpPlanner(const RvpOptions& options) : options_(options) {}

void RvpPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  mover_ = std::make_unique<ViewMover>(scene, options_.motion);
  targets_ = {};
  rng_ = Rng(scene.seed, "rvp views", static_cast<std::uint64_t>(scene.segment.index));
  patience_ = Patience();
}

void RvpPlanner::map_changed(MapChange change) {
  targets_ = std::move(change.targets);
  find_regions();
}

void RvpPlanner::find_regions() {
  Box around = scene_.segment.sampling_region_world;
  around.extend(transformed(scene_.segment.workspace_base, scene_.segment.T_world_base));
  nearness_.rebuild(*scene_.map, around);
}

Decision RvpPlanner::decide(const Configuration& q, WorkMeter& work) {
  int plans = 0;
  for (const Candidate& view : draw_and_choose(q, work)) {
    if (plans == options_.max_plans) break;
    const auto goal = mover_->reach(view.camera_world, view.target_world, q, work);
    if (!goal) continue;
    ++plans;
    if (auto decision = mover_->go(q, *goal, view.kind, work)) {
      patience_.renew();
      return *decision;
    }
  }
  return patience_.hold();
}

/// The list to try, best first: the ROI views when the best of them is worth it, else those that
/// explore: around what is occupied or, as long as nothing is, at the border of what is known.
std::vector<RvpPlanner::Candidate> RvpPlanner::draw_and_choose(const Configuration& q,
                                                               WorkMeter& work) {
  const Vec3 camera_now =
      (scene_.segment.T_world_base * scene_.robot->T_base_camera(q)).translation();
  auto roi = draw_views(TargetKind::roi, camera_now, work);
  const bool nothing_seen = targets_.roi.empty() && targets_.occupied.empty();
  auto explore =
      draw_views(nothing_seen ? TargetKind::border : TargetKind::occupied, camera_now, work);
  const bool worth_it = !roi.empty() && roi.front().utility > options_.roi_threshold;
  return worth_it ? roi : explore;
}

std::vector<RvpPlanner::Candidate> RvpPlanner::draw_views(TargetKind kind, const Vec3& camera_now,
                                                          WorkMeter& work) {
  const auto& voxels = kind == TargetKind::roi        ? targets_.roi
                       : kind == TargetKind::occupied ? targets_.occupied
                                                      : targets_.border;
  const Pose T_base_world = scene_.segment.T_world_base.inverse();
  std::vector<Candidate> views;
  for (int i = 0; i < options_.views_per_kind && !voxels.empty(); ++i) {
    const VoxelIndex& voxel = voxels[rng_.index(voxels.size())];
    Vec3 direction = random_direction(rng_);
    const double distance = rng_.uniform(options_.min_distance_m, options_.max_distance_m);
    work.add(Work::candidate);
    if (kind == TargetKind::occupied) direction = surface_normal(voxel).value_or(direction);
    Candidate view;
    view.kind = kind;
    view.target_world = voxel_centre(voxel, scene_.map->resolution_m());
    view.camera_world = view.target_world + distance * direction;
    if (!scene_.segment.workspace_base.contains(T_base_world * view.camera_world)) continue;
    view.utility = ray_gain(view.camera_world, view.target_world) -
                   options_.distance_weight * (view.camera_world - camera_now).norm();
    views.push_back(view);
  }
  std::stable_sort(views.begin(), views.end(),
                   [](const Candidate& a, const Candidate& b) { return a.utility > b.utility; });
  return views;
}

double RvpPlanner::ray_gain(const Vec3& camera_world, const Vec3& target_world) const {
  const double resolution = scene_.map->resolution_m();
  double sum = 0.0;
  walk_voxels(camera_world, target_world, resolution, [&](const VoxelIndex& voxel) {
    const Occupancy state = scene_.map->occupancy(voxel);
    if (state == Occupancy::unknown) {
      sum += 0.5 + 0.5 * nearness_.at(voxel_centre(voxel, resolution));
    }
    return state != Occupancy::occupied;
  });
  return sum / (VoxelWalk(camera_world, target_world, resolution).steps + 1);
}

std::optional<Vec3> RvpPlanner::surface_normal(const VoxelIndex& target) const {
  constexpr int kRadius = 2;
  Vec3 away = Vec3::Zero();
  for (int x = -kRadius; x <= kRadius; ++x) {
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int z = -kRadius; z <= kRadius; ++z) {
        const VoxelIndex offset(x, y, z);
        if (offset.isZero()) continue;
        if (scene_.map->occupancy(target + offset) == Occupancy::occupied) {
          away -= offset.cast<double>().normalized();
        }
      }
    }
  }
  if (away.norm() < 1e-6) return std::nullopt;
  return away.normalized();
}

Expected<std::string> RvpPlanner::state() const {
  if (!mover_) return fail("no segment has begun");
  return state_bytes(targets_, *mover_, rng_, patience_);
}

Expected<void> RvpPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  if (auto ok = read_state_bytes(state, targets_, *mover_, rng_, patience_); !ok) return ok;
  find_regions();
  return {};
}

}  // namespace canopeer
