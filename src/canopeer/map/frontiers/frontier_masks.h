#pragma once

#include "canopeer/base/simd_level.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// The frontier voxels of one block; see FrontierTargets.
struct FrontierMasks {
  VoxelMask roi;
  VoxelMask occupied;
  VoxelMask border;

  [[nodiscard]] bool any() const { return roi.any() || occupied.any() || border.any(); }
  friend bool operator==(const FrontierMasks&, const FrontierMasks&) = default;
};

/// Those of block `key`, which must be observed. `near_roi` false: no ROI voxel is in the block or
/// the 26 around it. `simd` must be a level the machine has; it changes the speed only.
FrontierMasks frontier_masks(const VoxelMap& map, BlockKey key, bool near_roi, SimdLevel simd);

}  // namespace canopeer
