#include "canopeer/map/view_cast.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/map/views/view_caster.h"

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

// The box around the fan, then all its rays.
template <typename Take>
auto cast_fan(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan, bool all,
              Take&& take) {
  CANOPEER_CHECK(fan.columns >= 1 && fan.rows >= 1, "a view fan has at least one ray");
  const double extent_x = std::tan(fan.fov_x_rad / 2.0);
  const double extent_y = std::tan(fan.fov_y_rad / 2.0);
  const auto end = [&](double x, double y) {
    return Vec3(T_world_camera * (fan.depth_m * Vec3(x, y, 1.0)));
  };
  const Vec3 from = T_world_camera.translation();
  Box world(from, from);
  for (const double x : {-extent_x, extent_x}) {
    for (const double y : {-extent_y, extent_y}) world.extend(end(x, y));
  }
  thread_local std::vector<Vec3> ends;
  ends.clear();
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column < fan.columns; ++column) {
      ends.push_back(end(place(column, fan.columns, extent_x), place(row, fan.rows, extent_y)));
    }
  }
  ViewCaster caster(map, world, all, best_simd_level());
  caster.cast(from, ends, fan.max_unknown_m);
  return take(caster);
}

}  // namespace

ViewCast cast_view(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan) {
  return cast_fan(map, T_world_camera, fan, false,
                  [](const ViewCaster& caster) { return caster.result(); });
}

SeenVoxels cast_view_all(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan) {
  return cast_fan(map, T_world_camera, fan, true,
                  [](const ViewCaster& caster) { return caster.all(); });
}

bool still_valid(const ViewCast& cast, const std::vector<BlockKey>& changed) {
  return std::none_of(changed.begin(), changed.end(),
                      [&](BlockKey key) { return cast.touched.contains(key); });
}

bool still_valid(const ViewCast& cast, const VoxelMap& map, std::uint64_t version) {
  return cast.touched.for_each([&](BlockKey key) { return map.block_version(key) <= version; });
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
