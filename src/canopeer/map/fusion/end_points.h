#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "canopeer/map/fusion.h"
#include "canopeer/map/fusion/frame_kernels.h"
#include "canopeer/map/storage/block_directory.h"

namespace canopeer {

/// Where the pixels of a frame end, and how far their rays are free. Both fusion modes stand on
/// it, so their hits are the same.
struct EndPoints {
  struct Block {
    BlockKey key = 0;
    VoxelMask hit;
    VoxelMask roi;  ///< ⊂ hit: a pixel of the ROI mask ended here
  };
  /// Of a block's voxels (x fastest) the largest confidence of the pixels that ended there.
  using Confidences = std::array<std::uint8_t, kBlockVoxels>;

  std::int64_t count = 0;
  BlockDirectory directory;   ///< key → index into blocks
  std::vector<Block> blocks;  ///< in order of first hit
  /// Parallel to blocks; empty unless the mask holds confidences.
  std::vector<Confidences> confidences;
  /// Per pixel the depth (along the axis) up to which its ray is free; 0: nowhere.
  DepthImage free_depth;
};

/// What `ends` held is forgotten, its memory used again.
void find_end_points(const RgbdFrame& frame, const Mask& roi, const FusionOptions& options,
                     double resolution_m, const FrameKernels& kernels, EndPoints& ends);

}  // namespace canopeer
