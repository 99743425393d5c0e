#pragma once

#include <vector>

#include "canopeer/fruit/surface/frame_depths.h"
#include "canopeer/fruit/surface/fruit_tsdf.h"

namespace canopeer {

/// A frame on its way into blocks of signed distances: every pixel with depth that looks through
/// a voxel is taken in.
class TsdfFusion {
 public:
  /// What is given stays where it is while this lives; `depths` are the frame's. `level`: changes
  /// the speed only.
  TsdfFusion(const RgbdFrame& frame, const Image<std::uint8_t>& classes, const FrameDepths& depths,
             const TsdfOptions& options, SimdLevel level = best_simd_level());

  void fuse(FruitTsdf::Block& block) const;

  /// A voxel near the surface that its pixel sees.
  struct NearVoxel {
    std::size_t voxel = 0;
    float weight = 0.0F;
    int u = 0, v = 0;  ///< the pixel, counted from the border around the image
  };
  /// What all voxels of a frame have in common.
  struct Common {
    Eigen::Matrix3f step;  ///< from voxel to voxel along x, y, z, camera frame
    const float* depths = nullptr;
    float fx = 0.0F, fy = 0.0F;
    float cx = 0.0F, cy = 0.0F;          ///< counted from the border around the image
    float last_u = 0.0F, last_v = 0.0F;  ///< the border
    int stride = 0;
    float truncation = 0.0F, max_weight = 0.0F, near_surface = 0.0F, changed = 0.0F;
  };

 private:
  [[nodiscard]] bool in_sight(const Vec3& centre_camera, double reach_m) const;
  void fuse_cube(FruitTsdf::Block& block, const VoxelIndex& first) const;
  void take_looks(TsdfLooks& looks, const NearVoxel& near) const;

  const RgbdFrame& frame_;
  const Image<std::uint8_t>& classes_;
  const FrameDepths& depths_;
  const TsdfOptions& options_;
  Pose T_camera_world_;
  Common common_;
  SimdLevel level_;
};

}  // namespace canopeer
