#pragma once

#include "canopeer/map/fusion/free_space.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// The voxels that the pixels' rays cross before the voxel they end in, exactly as walk_voxels()
/// says: all that walking every ray up to its `free_depth` (per pixel, along the axis; 0: not at
/// all) would find, most of it without walking. What `free` held is forgotten, its memory used
/// again.
void find_crossed_space(const RgbdFrame& frame, const DepthImage& free_depth, double resolution_m,
                        const FrameKernels& kernels, FreeSpace& free);

}  // namespace canopeer
