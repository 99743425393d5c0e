#pragma once

#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/map/views/block_set.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/map/voxel_set.h"

namespace canopeer {

/// The rays that stand for a camera's view: from the optical centre to a grid of points on the
/// plane at `depth_m`. The points are evenly spaced, the outermost on the border of the field of
/// view. Angles in (0, π); columns and rows ≥ 1 (a single one lies in the middle).
struct ViewFan {
  double fov_x_rad = 80.0 * std::numbers::pi / 180.0;
  double fov_y_rad = 60.0 * std::numbers::pi / 180.0;
  int columns = 16;
  int rows = 12;
  double depth_m = 1.0;  ///< along the optical axis, of every ray's end
  /// A ray ends when it has crossed so much unknown space (rounded up to voxels, at least one).
  /// What lies behind is likely hidden by something not seen yet. Infinite: as in [Zaenker23].
  double max_unknown_m = std::numeric_limits<double>::infinity();
};

/// What a view would see that is not known yet.
struct ViewCast {
  VoxelSet unknown;  ///< the distinct unknown voxels the rays cross
  BlockSet touched;  ///< the result holds as long as these do not change
};

/// What a camera at T_world_camera (optical frame) would newly see: C(n) of [Zaenker23] Alg. 1 for
/// one view. Rays stop before the first occupied voxel, or after `fan.max_unknown_m` of
/// unknown ones.
ViewCast cast_view(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan = {});

/// All that the view sees, not only what is new.
struct SeenVoxels {
  VoxelSet unknown;
  VoxelSet free;
  VoxelSet occupied;  ///< where rays stop
  VoxelSet roi;       ///< ⊂ free ∪ occupied ∪ unknown
  BlockSet touched;
};

/// As cast_view(), for every kind of voxel; slower, as rays then step through free space too.
SeenVoxels cast_view_all(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan = {});

/// None of the blocks the rays crossed is in `changed`.
bool still_valid(const ViewCast& cast, const std::vector<BlockKey>& changed);
/// The same by version stamps: no block the rays crossed has changed after update number
/// `version` of the map (VoxelMap::version() when the view was cast).
bool still_valid(const ViewCast& cast, const VoxelMap& map, std::uint64_t version);

/// An occupied voxel lies on the segment from → to, both ends included, the first
/// `ignore_near_from_m` left out.
bool ray_blocked(const VoxelMap& map, const Vec3& from, const Vec3& to,
                 double ignore_near_from_m = 0.0);

}  // namespace canopeer
