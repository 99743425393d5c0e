#include "canopeer/map/view_cast.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/map/block_directory.h"

namespace canopeer {
namespace {

// The i-th of `count` places on [−extent, extent], ends included.
double place(int i, int count, double extent) {
  return count == 1 ? 0.0 : extent * (2.0 * i / (count - 1) - 1.0);
}

bool in_block(const VoxelIndex& voxel, const VoxelIndex& origin) {
  return (((voxel.x() ^ origin.x()) | (voxel.y() ^ origin.y()) | (voxel.z() ^ origin.z())) &
          ~(kBlockSide - 1)) == 0;
}

// Collects the unknown voxels along rays.
class Caster {
 public:
  Caster(const VoxelMap& map, std::size_t expected_blocks)
      : map_(map), directory_(expected_blocks) {
    crossed_.reserve(expected_blocks);
    masks_.reserve(expected_blocks);
  }

  void cast(const Vec3& from, const Vec3& to) {
    walk_voxels(from, to, map_.resolution_m(), [this](const VoxelIndex& voxel) {
      if (!in_block(voxel, origin_) || crossed_.empty()) enter(voxel);
      const auto slice = static_cast<std::size_t>(VoxelMask::slice_of(voxel));
      const std::uint64_t bit = VoxelMask::bit_of(voxel);
      const BlockMasks* known = masks_[slot_];
      if (known != nullptr) {
        if ((known->occupied.slices[slice] & bit) != 0) return false;
        if ((known->observed.slices[slice] & bit) != 0) return true;
      }
      crossed_[slot_].mask.slices[slice] |= bit;
      return true;
    });
  }

  ViewCast result() {
    ViewCast cast;
    cast.touched.reserve(crossed_.size());
    for (const VoxelSet::Block& block : crossed_) cast.touched.push_back(block.key);
    std::sort(cast.touched.begin(), cast.touched.end());
    cast.unknown = VoxelSet(std::move(crossed_));
    return cast;
  }

 private:
  void enter(const VoxelIndex& voxel) {
    const BlockKey key = block_key(voxel);
    origin_ = block_origin(key);
    slot_ = directory_.find_or_add(key);
    if (slot_ < crossed_.size()) return;
    crossed_.push_back({key, {}});
    masks_.push_back(map_.block(key));
  }

  const VoxelMap& map_;
  BlockDirectory directory_;
  std::vector<VoxelSet::Block> crossed_;
  std::vector<const BlockMasks*> masks_;  // of the crossed blocks in the map
  VoxelIndex origin_ = VoxelIndex::Zero();
  std::uint32_t slot_ = 0;
};

}  // namespace

ViewCast cast_view(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan) {
  CANOPEER_CHECK(fan.columns >= 1 && fan.rows >= 1, "a view fan has at least one ray");
  const double extent_x = std::tan(fan.fov_x_rad / 2.0);
  const double extent_y = std::tan(fan.fov_y_rad / 2.0);
  // About as many blocks as the fan's pyramid of space holds, or its rays can cross.
  const double block_m = kBlockSide * map.resolution_m();
  const double depth = fan.depth_m / block_m;
  const double estimate = std::min(2.0 * depth * fan.columns * fan.rows,
                                   2.0 * extent_x * extent_y * depth * depth * depth);
  Caster caster(map, static_cast<std::size_t>(std::clamp(estimate, 64.0, 16384.0)));
  const Vec3 from = T_world_camera.translation();
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column < fan.columns; ++column) {
      const Vec3 direction(place(column, fan.columns, extent_x), place(row, fan.rows, extent_y),
                           1.0);
      caster.cast(from, T_world_camera * (fan.depth_m * direction));
    }
  }
  return caster.result();
}

bool still_valid(const ViewCast& cast, const std::vector<BlockKey>& changed_sorted) {
  auto it = changed_sorted.begin();
  for (const BlockKey key : cast.touched) {
    it = std::lower_bound(it, changed_sorted.end(), key);
    if (it == changed_sorted.end()) return true;
    if (*it == key) return false;
  }
  return true;
}

bool ray_blocked(const VoxelMap& map, const Vec3& from, const Vec3& to, double ignore_near_from_m) {
  const double length = (to - from).norm();
  if (length <= ignore_near_from_m) return false;
  const Vec3 start =
      ignore_near_from_m > 0.0 ? Vec3(from + (to - from) * (ignore_near_from_m / length)) : from;
  const BlockMasks* masks = map.block(block_key(voxel_at(start, map.resolution_m())));
  VoxelIndex origin = block_origin(block_key(voxel_at(start, map.resolution_m())));
  return !walk_voxels(start, to, map.resolution_m(), [&](const VoxelIndex& voxel) {
    if (!in_block(voxel, origin)) {
      const BlockKey key = block_key(voxel);
      origin = block_origin(key);
      masks = map.block(key);
    }
    return masks == nullptr || !masks->occupied.test(voxel);
  });
}

}  // namespace canopeer
