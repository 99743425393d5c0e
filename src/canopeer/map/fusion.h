#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/map/voxel_map.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// Which pixels of a frame count, and for how much.
struct FusionOptions {
  /// Points farther from the camera (Euclidean) are no end points; space is freed up to here.
  double max_range_m = 3.0;
  /// A pixel without return (0, NaN, infinite) frees its ray up to max_range_m. A negative one
  /// (what the robot's own links are masked with) never does. Off by default: a surface too near
  /// gives no return either.
  bool clear_no_return = false;
  /// Pixels of the ROI mask are how sure the detector is, 0 … 255, instead of no (0) and yes. The
  /// ROI probability of a hit rises with it from miss_probability to hit_probability. A voxel takes
  /// its surest pixel. A mask of 0 and 255 gives the same either way.
  bool roi_is_confidence = false;
  /// Not above best_simd_level(). Changes the speed only.
  SimdLevel simd = best_simd_level();
};

/// What a frame changed in the map.
struct FuseResult {
  std::int64_t fused_points = 0;    ///< pixels that were end points
  std::int64_t newly_known = 0;     ///< voxels unknown before, known after
  std::int64_t updated_voxels = 0;  ///< voxels that got a hit or a miss
  /// Blocks whose observed, occupied or ROI masks changed, sorted.
  std::vector<BlockKey> changed;
};

/// Fuses one frame, every voxel at most once. Voxels that hold an end point get a hit; of the
/// others, those whose centre is seen in front of the surface get a miss. ROI log-odds change in
/// voxels with end points only: a hit when a pixel of `roi` ended there, else a miss. An empty
/// `roi` (frame not segmented) leaves them alone. Depth that is NaN, infinite, ≤ 0 or out of range
/// is no end point. `roi` is empty or as large as the depth image; the pose is finite. The result
/// does not depend on the number of threads.
FuseResult fuse(VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                const FusionOptions& options = {});

/// The same hits; misses by walking every pixel's ray, as OctoMap does. The slow oracle.
FuseResult fuse_exact(VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                      const FusionOptions& options = {});

}  // namespace canopeer
