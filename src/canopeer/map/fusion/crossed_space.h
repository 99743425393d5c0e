#pragma once

#include "canopeer/map/fusion/free_space.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// The voxels that the pixels' rays cross before the voxel they end in, exactly as walk_voxels()
/// says. Each ray goes up to its `free_depth` (per pixel, along the axis; 0: not at all). The
/// result is that of walking every ray, but most of it is found without walking. What `free` held
/// is forgotten, its memory used again.
void find_crossed_space(const RgbdFrame& frame, const DepthImage& free_depth, double resolution_m,
                        const FrameKernels& kernels, FreeSpace& free);

}  // namespace canopeer
