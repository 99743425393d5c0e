#include "canopeer/planner/gomvp/chosen_views.h"

#include <cmath>
#include <utility>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

bool in_fan(const Vec3& p_camera, const ViewFan& fan) {
  return p_camera.z() > 0.0 && p_camera.z() <= fan.depth_m &&
         std::abs(p_camera.x()) <= p_camera.z() * std::tan(fan.fov_x_rad / 2) &&
         std::abs(p_camera.y()) <= p_camera.z() * std::tan(fan.fov_y_rad / 2);
}

bool ray_is_clear(const VoxelMap& map, const Vec3& from, const Vec3& to, double max_unknown_m) {
  double unknown_m = 0.0;
  const double length_m = (to - from).norm();
  const VoxelWalk walk(from, to, map.resolution_m());
  const double step_m = length_m / (walk.steps + 1);
  return walk_voxels(from, to, map.resolution_m(), [&](const VoxelIndex& voxel) {
    const Occupancy occupancy = map.occupancy(voxel);
    if (occupancy == Occupancy::unknown) unknown_m += step_m;
    return occupancy != Occupancy::occupied && unknown_m <= max_unknown_m;
  });
}

double worth(const ChosenView& view, const std::vector<double>& left) {
  double sum = 0.0;
  for (const int target : view.targets) sum += left[static_cast<std::size_t>(target)];
  return sum;
}

}  // namespace

bool sees(const VoxelMap& map, const Pose& T_world_camera, const Vec3& p_world,
          const ViewFan& fan) {
  return in_fan(T_world_camera.inverse() * p_world, fan) &&
         ray_is_clear(map, T_world_camera.translation(), p_world, fan.max_unknown_m);
}

std::vector<ChosenView> choose_views(const ViewGraph& graph, const GraphWays& ways,
                                     const VoxelMap& map, const std::vector<CoverTarget>& targets,
                                     const std::vector<double>& weights,
                                     const GomvpOptions& options, WorkMeter& work) {
  std::vector<Vec3> points;
  for (const CoverTarget& target : targets)
    points.push_back(voxel_centre(target.voxel, map.resolution_m()));

  std::vector<ChosenView> candidates;
  int asked = 0;
  std::int64_t rays = 0;
  for (std::size_t i = graph.id_count(); i-- > 0 && asked < options.max_candidates;) {
    const auto id = static_cast<NodeId>(i);
    const ViewNode& node = graph.node(id);
    if (node.removed || node.visited || ways.time_s(id) == GraphWays::kNoWay) continue;
    ++asked;
    const Pose& T_world_camera = node.view.T_world_camera;
    const Pose T_camera_world = T_world_camera.inverse();
    ChosenView view{id, {}};
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (!in_fan(T_camera_world * points[j], options.fan)) continue;
      ++rays;
      if (ray_is_clear(map, T_world_camera.translation(), points[j], options.fan.max_unknown_m))
        view.targets.push_back(static_cast<int>(j));
    }
    if (!view.targets.empty()) candidates.push_back(std::move(view));
  }
  work.add(Work::candidate, rays);  // each has a ray to its target

  std::vector<ChosenView> chosen;
  std::vector<double> left = weights;
  std::vector<int> seen(targets.size(), 0);
  while (static_cast<int>(chosen.size()) < options.max_views && !candidates.empty()) {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double value = worth(candidates[i], left);
      if (value <= most) continue;
      most = value;
      best = i;
    }
    chosen.push_back(std::move(candidates[best]));
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(best));
    for (const int target : chosen.back().targets) {
      const auto j = static_cast<std::size_t>(target);
      left[j] = weights[j] / (1.0 + ++seen[j]);
    }
  }
  return chosen;
}

}  // namespace canopeer
