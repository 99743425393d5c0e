#include "canopeer/planner/rvp/roi_nearness.h"

#include <algorithm>
#include <cmath>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

RoiNearness::RoiNearness(double reach_m, double cell_m) : reach_m_(reach_m), cell_m_(cell_m) {}

void RoiNearness::rebuild(const VoxelMap& map, const Box& world) {
  first_ = voxel_at(world.min(), cell_m_);
  size_ = voxel_at(world.max(), cell_m_) - first_ + VoxelIndex::Ones();
  const auto cells = static_cast<std::size_t>(size_.prod());
  value_.assign(cells, 0.0F);
  std::vector<bool> done(cells, false);
  map.for_each_roi(world, [&](const VoxelIndex& voxel) {
    const VoxelIndex cell = voxel_at(voxel_centre(voxel, map.resolution_m()), cell_m_);
    const std::size_t number = cell_number(cell);
    if (!done[number]) raise_around(cell);
    done[number] = true;
  });
}

double RoiNearness::at(const Vec3& p_world) const {
  const VoxelIndex cell = voxel_at(p_world, cell_m_);
  const VoxelIndex local = cell - first_;
  if ((local.array() < 0).any() || (local.array() >= size_.array()).any()) return 0.0;
  return value_[cell_number(cell)];
}

std::size_t RoiNearness::cell_number(const VoxelIndex& cell) const {
  const VoxelIndex local = cell - first_;
  return static_cast<std::size_t>((local.z() * size_.y() + local.y()) * size_.x() + local.x());
}

void RoiNearness::raise_around(const VoxelIndex& cell) {
  const int r = static_cast<int>(std::floor(reach_m_ / cell_m_));
  const VoxelIndex low = (cell.array() - r).max(first_.array());
  const VoxelIndex high = (cell.array() + r).min((first_ + size_).array() - 1);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const VoxelIndex at(x, y, z);
        const double distance_m = (at - cell).cast<double>().norm() * cell_m_;
        float& value = value_[cell_number(at)];
        value = std::max(value, static_cast<float>(1.0 - distance_m / reach_m_));
      }
    }
  }
}

}  // namespace canopeer
