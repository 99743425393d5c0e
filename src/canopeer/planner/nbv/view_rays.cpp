#include "canopeer/planner/nbv/view_rays.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

constexpr double kEndOfSight = 0.01;

double probability(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

/// The i-th of `count` places on [−extent, extent], ends included.
double place_on(int i, int count, double extent) {
  return count == 1 ? 0.0 : extent * (2.0 * i / (count - 1) - 1.0);
}

/// Voxels of the box around a view's rays, each with its highest visibility.
class SeenBox {
 public:
  SeenBox(const Box& world, double resolution_m)
      : first_(voxel_at(world.min(), resolution_m) - VoxelIndex::Ones()),
        size_(voxel_at(world.max(), resolution_m) - first_ + 2 * VoxelIndex::Ones()),
        places_(scratch()) {
    const std::size_t cells = cell(first_ + size_ - VoxelIndex::Ones()) + 1;
    if (places_.size() < cells) places_.resize(cells, 0);
  }
  ~SeenBox() {
    for (const VisibleVoxel& seen : seen_) places_[cell(seen.voxel)] = 0;
  }
  SeenBox(const SeenBox&) = delete;
  SeenBox& operator=(const SeenBox&) = delete;

  void see(const VoxelIndex& voxel, double visibility) {
    std::uint32_t& place = places_[cell(voxel)];
    if (place == 0) {
      seen_.push_back({voxel, visibility});
      place = static_cast<std::uint32_t>(seen_.size());
    } else {
      double& known = seen_[place - 1].visibility;
      known = std::max(known, visibility);
    }
  }
  [[nodiscard]] const std::vector<VisibleVoxel>& seen() const { return seen_; }

 private:
  /// All 0 between two boxes: clearing what was used is much less than clearing the box.
  static std::vector<std::uint32_t>& scratch() {
    thread_local std::vector<std::uint32_t> places;
    return places;
  }
  [[nodiscard]] std::size_t cell(const VoxelIndex& voxel) const {
    const VoxelIndex at = voxel - first_;
    return (static_cast<std::size_t>(at.z()) * static_cast<std::size_t>(size_.y()) +
            static_cast<std::size_t>(at.y())) *
               static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(at.x());
  }

  VoxelIndex first_;
  VoxelIndex size_;
  std::vector<std::uint32_t>& places_;  // in seen_, from 1; 0: not seen
  std::vector<VisibleVoxel> seen_;
};

}  // namespace

std::vector<Vec3> ray_ends(const ViewFan& fan, const Pose& T_world_camera) {
  const double extent_x = std::tan(fan.fov_x_rad / 2.0);
  const double extent_y = std::tan(fan.fov_y_rad / 2.0);
  std::vector<Vec3> ends;
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column < fan.columns; ++column) {
      const Vec3 direction(place_on(column, fan.columns, extent_x),
                           place_on(row, fan.rows, extent_y), 1.0);
      ends.emplace_back(T_world_camera * (fan.depth_m * direction));
    }
  }
  return ends;
}

std::vector<VisibleVoxel> visible_voxels(const GainScene& scene, const Pose& T_world_camera) {
  const double resolution_m = scene.map.resolution_m();
  const double share_of_cell = std::min(1.0, resolution_m / scene.visibility_cell_m);
  const double through_unknown = std::pow(0.5, share_of_cell);
  const Vec3 from = T_world_camera.translation();
  const std::vector<Vec3> ends = ray_ends(scene.fan, T_world_camera);
  Box world(from, from);
  for (const Vec3& end : ends) world.extend(end);
  SeenBox seen(world, resolution_m);
  for (const Vec3& end : ends) {
    double visibility = 1.0;
    walk_voxels(from, end, resolution_m, [&](const VoxelIndex& voxel) {
      seen.see(voxel, visibility);
      switch (scene.map.occupancy(voxel)) {
        case Occupancy::unknown:
          visibility *= through_unknown;
          break;
        case Occupancy::free:
          visibility *=
              std::pow(1.0 - probability(scene.map.occupancy_log_odds(voxel)), share_of_cell);
          break;
        case Occupancy::occupied:
          visibility *= 1.0 - probability(scene.map.occupancy_log_odds(voxel));
          break;
      }
      return visibility >= kEndOfSight;
    });
  }
  return seen.seen();
}

double entropy_bit(double log_odds) {
  const double p = probability(log_odds);
  if (p <= 0.0 || p >= 1.0) return 0.0;
  return -p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p);
}

}  // namespace canopeer
