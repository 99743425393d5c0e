#pragma once

#include <vector>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/planner/nbv/fruit_distance.h"

namespace canopeer {

/// What a gain is computed from; map and distances do not change meanwhile.
struct GainScene {
  const VoxelMap& map;
  const FruitDistance& fruit;
  ViewFan fan;
  /// Visibility is reckoned per so much of the way: see visible_voxels().
  double visibility_cell_m = 0.05;
};

/// A voxel a view looks into, and how likely its light gets to the camera.
struct VisibleVoxel {
  VoxelIndex voxel;
  double visibility = 0.0;
};

/// Every voxel on a ray of the view, once: with the highest visibility any of the rays gives it.
///
///     v_k = Π_{m<k} (1 − p_occ,m)      (Cuaran et al., arXiv 2412.10515)
///
/// over the voxels the ray crosses before. That product is meant for their coarse maps: at 1 cm,
/// free voxels of p = 0.12 alone would end it after a few decimetres. So a voxel that is not
/// occupied lets through (1 − p)^(resolution / visibility_cell), as if p held for a cell of that
/// size; an occupied one lets through 1 − p. A ray ends where less than 1 % is left.
[[nodiscard]] std::vector<VisibleVoxel> visible_voxels(const GainScene& scene,
                                                       const Pose& T_world_camera);

/// The ends of the fan's rays, world; as cast_view() has them.
[[nodiscard]] std::vector<Vec3> ray_ends(const ViewFan& fan, const Pose& T_world_camera);

/// −p log2 p − (1 − p) log2(1 − p), bit, of a log-odds; 1 at 0.
[[nodiscard]] double entropy_bit(double log_odds);

}  // namespace canopeer
