#pragma once

#include "canopeer/planner/nbv/view_rays.h"

namespace canopeer {

// What a view is worth: the gains that Cuaran et al. compare (arXiv 2412.10515). Each depends on
// map, distances and pose alone; thread-safe. All count a voxel once, however many rays cross it
// (our reading).

/// UVC: the unknown voxels on the view's rays before the first occupied one.
[[nodiscard]] double uvc_gain(const GainScene& scene, const Pose& T_world_camera);

/// UVPC: of the same voxels those nearer than 0.1 m to a fruit, each with
/// 0.5 + (0.1 − d) / 0.1, d its distance (m) to the nearest voxel of one.
[[nodiscard]] double uvpc_gain(const GainScene& scene, const Pose& T_world_camera);

/// OAE: Σ H(p_occ) · v over all voxels on the rays (visible_voxels()).
[[nodiscard]] double oae_gain(const GainScene& scene, const Pose& T_world_camera);

/// OSAMCEP: Σ H(class) · v over the fruit
/// voxels on the rays, and over the unknown ones nearer than 0.1 m to a fruit. H(class): of the
/// voxel's probability to be fruit (its ROI log-odds; 1 bit where it was never observed).
[[nodiscard]] double osamcep_gain(const GainScene& scene, const Pose& T_world_camera);

}  // namespace canopeer
