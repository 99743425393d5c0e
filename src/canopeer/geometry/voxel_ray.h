#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// Index of a voxel: floor(p / resolution) per axis; negative indices are ordinary.
using VoxelIndex = Eigen::Vector3i;

inline VoxelIndex voxel_at(const Vec3& p, double resolution_m) {
  return {static_cast<int>(std::floor(p.x() / resolution_m)),
          static_cast<int>(std::floor(p.y() / resolution_m)),
          static_cast<int>(std::floor(p.z() / resolution_m))};
}

inline Vec3 voxel_centre(const VoxelIndex& v, double resolution_m) {
  return (v.cast<double>().array() + 0.5).matrix() * resolution_m;
}

/// How a segment crosses the voxels, face by face (Amanatides & Woo, Eurographics 1987): `steps`
/// faces are crossed, of axis a the first at time t_next[a] and then every t_delta[a]. Times are
/// fixed point, so that adding them up in whatever portions gives the same order.
struct VoxelWalk {
  /// Time at the segment's end. Sums over some dozen crossings beyond it do not overflow.
  static constexpr std::int64_t kEnd = std::int64_t{1} << 56;

  VoxelWalk(const Vec3& from, const Vec3& to, double resolution_m)
      : first(voxel_at(from, resolution_m)) {
    const VoxelIndex last = voxel_at(to, resolution_m);
    for (int axis = 0; axis < 3; ++axis) {
      const double d = to[axis] - from[axis];
      const int crossings = d == 0.0 ? 0 : std::abs(last[axis] - first[axis]);
      step[axis] = d > 0.0 ? 1 : -1;
      t_next[axis] = std::numeric_limits<std::int64_t>::max();
      t_delta[axis] = 0;
      steps += crossings;
      if (crossings == 0) continue;
      const double face = (first[axis] + (d > 0.0 ? 1 : 0)) * resolution_m;
      const auto time = [](double t) { return static_cast<std::int64_t>(t * kEnd); };
      t_next[axis] = time(std::clamp((face - from[axis]) / d, 0.0, 1.0));
      t_delta[axis] = crossings == 1 ? kEnd + 1 : time(resolution_m / std::abs(d));
      // Whatever rounding says, the last crossing is not after the end, and one more would be. So
      // the walk makes `steps` steps and ends in the end's voxel.
      const std::int64_t late = t_next[axis] + (crossings - 1) * t_delta[axis] - kEnd;
      if (late > 0) t_next[axis] = std::max<std::int64_t>(0, t_next[axis] - late);
      const std::int64_t early = kEnd + 1 - (t_next[axis] + crossings * t_delta[axis]);
      if (early > 0) t_delta[axis] += early / crossings + 1;
    }
  }

  VoxelIndex first;
  int step[3];
  std::int64_t t_next[3];
  std::int64_t t_delta[3];
  int steps = 0;
};

/// Visits every voxel the segment from → to crosses, in order, both ends included. `visit(
/// VoxelIndex)` returns false to stop early. Returns false when stopped.
///
/// Which axis steps next is as good as random, so the loop has no branch on it: `on ? x : 0` by bit
/// masks.
template <typename Visit>
bool walk_voxels(const Vec3& from, const Vec3& to, double resolution_m, Visit&& visit) {
  const VoxelWalk walk(from, to, resolution_m);
  int x = walk.first.x();
  int y = walk.first.y();
  int z = walk.first.z();
  std::int64_t tx = walk.t_next[0];
  std::int64_t ty = walk.t_next[1];
  std::int64_t tz = walk.t_next[2];
  for (int steps = walk.steps;; --steps) {
    if (!visit(VoxelIndex(x, y, z))) return false;
    if (steps == 0) return true;
    const auto x_before_y = -static_cast<std::int64_t>(tx < ty);
    const auto on_z = -static_cast<std::int64_t>(tz < (tx < ty ? tx : ty));
    const std::int64_t on_x = x_before_y & ~on_z;
    const std::int64_t on_y = ~x_before_y & ~on_z;
    x += walk.step[0] & static_cast<int>(on_x);
    y += walk.step[1] & static_cast<int>(on_y);
    z += walk.step[2] & static_cast<int>(on_z);
    tx += walk.t_delta[0] & on_x;
    ty += walk.t_delta[1] & on_y;
    tz += walk.t_delta[2] & on_z;
  }
}

}  // namespace canopeer
