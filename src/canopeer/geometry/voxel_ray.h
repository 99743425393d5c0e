#pragma once

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

/// Visits every voxel the segment from → to crosses, in order, both ends included (Amanatides &
/// Woo, Eurographics 1987). `visit(VoxelIndex)` returns false to stop early. Returns false when
/// stopped.
template <typename Visit>
bool walk_voxels(const Vec3& from, const Vec3& to, double resolution_m, Visit&& visit) {
  VoxelIndex voxel = voxel_at(from, resolution_m);
  const VoxelIndex last = voxel_at(to, resolution_m);
  const Vec3 direction = to - from;
  VoxelIndex step;
  Vec3 t_next;
  Vec3 t_delta;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (voxel[axis] == last[axis] || d == 0.0) {
      step[axis] = 0;
      t_next[axis] = t_delta[axis] = std::numeric_limits<double>::infinity();
      continue;
    }
    step[axis] = d > 0.0 ? 1 : -1;
    const double border = (voxel[axis] + (d > 0.0 ? 1 : 0)) * resolution_m;
    t_next[axis] = (border - from[axis]) / d;
    t_delta[axis] = resolution_m / std::abs(d);
  }
  int steps = (last - voxel).cwiseAbs().sum();
  while (true) {
    if (!visit(voxel)) return false;
    if (steps-- == 0) return true;
    int axis = t_next.x() < t_next.y() ? 0 : 1;
    if (t_next.z() < t_next[axis]) axis = 2;
    voxel[axis] += step[axis];
    // An axis that has arrived never moves again, whatever rounding says: the walk ends exactly at
    // `last`.
    t_next[axis] = voxel[axis] == last[axis] ? std::numeric_limits<double>::infinity()
                                             : t_next[axis] + t_delta[axis];
  }
}

}  // namespace canopeer
