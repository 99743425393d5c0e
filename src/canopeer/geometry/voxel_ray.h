#pragma once

#include <bit>
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
///
/// Which axis steps next is as good as random, so the loop has no branch on it: `on ? x : 0` by bit
/// masks.
template <typename Visit>
bool walk_voxels(const Vec3& from, const Vec3& to, double resolution_m, Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto masked = [](double value, std::uint64_t mask) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & mask);
  };
  const VoxelIndex first = voxel_at(from, resolution_m);
  const VoxelIndex last = voxel_at(to, resolution_m);
  const Vec3 direction = to - from;
  int step[3];
  int left[3];       // steps an axis has still to make
  double t_next[3];  // where on the segment (0 … 1) an axis steps next
  double t_delta[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    left[axis] = d == 0.0 ? 0 : std::abs(last[axis] - first[axis]);
    step[axis] = d > 0.0 ? 1 : -1;
    const double border = (first[axis] + (d > 0.0 ? 1 : 0)) * resolution_m;
    t_next[axis] = left[axis] == 0 ? kNever : (border - from[axis]) / d;
    t_delta[axis] = left[axis] == 0 ? 0.0 : resolution_m / std::abs(d);
  }
  int x = first.x();
  int y = first.y();
  int z = first.z();
  double tx = t_next[0];
  double ty = t_next[1];
  double tz = t_next[2];
  for (int steps = left[0] + left[1] + left[2];; --steps) {
    if (!visit(VoxelIndex(x, y, z))) return false;
    if (steps == 0) return true;
    const std::uint64_t x_before_y = -static_cast<std::uint64_t>(tx < ty);
    const std::uint64_t z_first = -static_cast<std::uint64_t>(tz < (tx < ty ? tx : ty));
    const std::uint64_t on_x = x_before_y & ~z_first;
    const std::uint64_t on_y = ~x_before_y & ~z_first;
    x += step[0] & static_cast<int>(on_x);
    y += step[1] & static_cast<int>(on_y);
    z += step[2] & static_cast<int>(z_first);
    left[0] += static_cast<int>(on_x);
    left[1] += static_cast<int>(on_y);
    left[2] += static_cast<int>(z_first);
    // An axis that has arrived never moves again, whatever rounding says: the walk ends exactly at
    // `last`.
    tx += masked(left[0] == 0 ? kNever : t_delta[0], on_x);
    ty += masked(left[1] == 0 ? kNever : t_delta[1], on_y);
    tz += masked(left[2] == 0 ? kNever : t_delta[2], z_first);
  }
}

}  // namespace canopeer
