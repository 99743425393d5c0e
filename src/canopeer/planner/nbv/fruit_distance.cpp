#include "canopeer/planner/nbv/fruit_distance.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

constexpr std::int32_t kBeyondReach = 1 << 28;  // sums with a square do not overflow

}  // namespace

void FruitDistance::rebuild(const VoxelMap& map, const Box& world) {
  resolution_m_ = map.resolution_m();
  reach_ = static_cast<int>(std::ceil(reach_m_ / resolution_m_));
  size_ = VoxelIndex::Zero();
  squared_.clear();
  std::vector<VoxelIndex> fruit;
  map.for_each_roi(world, [&](const VoxelIndex& voxel) { fruit.push_back(voxel); });
  if (fruit.empty()) return;
  VoxelIndex low = fruit.front();
  VoxelIndex high = fruit.front();
  for (const VoxelIndex& voxel : fruit) {
    low = low.cwiseMin(voxel);
    high = high.cwiseMax(voxel);
  }
  first_ = low.array() - reach_;
  size_ = (high - low).array() + 2 * reach_ + 1;
  squared_.assign(cell(size_ - VoxelIndex::Ones()) + 1, kBeyondReach);
  for (const VoxelIndex& voxel : fruit) squared_[cell(voxel - first_)] = 0;
  // The distance transform is separable: squares along an axis add up (Felzenszwalb &
  // Huttenlocher, Theory of Computing 2012). Within so short a reach trying all is quick.
  for (int axis = 0; axis < 3; ++axis) spread(axis);
}

std::optional<double> FruitDistance::at(const VoxelIndex& voxel) const {
  const VoxelIndex local = voxel - first_;
  if ((local.array() < 0).any() || (local.array() >= size_.array()).any()) return std::nullopt;
  const double distance_m = std::sqrt(static_cast<double>(squared_[cell(local)])) * resolution_m_;
  if (distance_m >= reach_m_) return std::nullopt;
  return distance_m;
}

std::size_t FruitDistance::cell(const VoxelIndex& local) const {
  return (static_cast<std::size_t>(local.z()) * static_cast<std::size_t>(size_.y()) +
          static_cast<std::size_t>(local.y())) *
             static_cast<std::size_t>(size_.x()) +
         static_cast<std::size_t>(local.x());
}

void FruitDistance::spread(int axis) {
  const std::vector<std::int32_t> before = squared_;
  const std::size_t stride = cell(VoxelIndex::Unit(axis));
  const std::size_t cells = squared_.size();
  const auto length = static_cast<std::size_t>(size_[axis]);
  for (int k = 1; k <= reach_; ++k) {
    const std::size_t shift = static_cast<std::size_t>(k) * stride;
    if (static_cast<std::size_t>(k) >= length) break;
    // Runs of cells whose neighbour k away lies in the same line.
    const std::size_t run = (length - static_cast<std::size_t>(k)) * stride;
    for (std::size_t line = 0; line < cells; line += length * stride) {
      for (std::size_t i = line; i < line + run; ++i) {
        squared_[i] = std::min(squared_[i], before[i + shift] + k * k);
        squared_[i + shift] = std::min(squared_[i + shift], before[i] + k * k);
      }
    }
  }
}

}  // namespace canopeer
