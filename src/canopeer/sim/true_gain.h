#pragma once

#include <memory>

#include "canopeer/map/view_cast.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// How the true scene is looked at.
struct TrueGainOptions {
  int width_px = 80;  ///< of the images; about a voxel a pixel at half a metre
  int height_px = 60;
  double max_range_m = 1.0;  ///< along the optical axis, as VMP's rays
};

/// What a view would really show of the fruits that count, without noise: the wish no planner can
/// have. With it in place of cast_view() the same search shows how much of a planner's loss is its
/// gain's. Thread-safe.
class TrueGain {
 public:
  /// `fan`: its field of view is the camera's. The scene is copied.
  TrueGain(const Scene& scene, const ViewFan& fan, const TrueGainOptions& options = {});
  ~TrueGain();
  TrueGain(const TrueGain&) = delete;
  TrueGain& operator=(const TrueGain&) = delete;

  /// The voxels on the surface of counted fruits that a camera (optical frame) sees: those with
  /// the point of a pixel in them.
  [[nodiscard]] VoxelSet fruit_voxels(const Pose& T_world_camera, double resolution_m) const;
  /// Those of them that the map has not observed, as `unknown`.
  [[nodiscard]] ViewCast cast(const VoxelMap& map, const Pose& T_world_camera) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
