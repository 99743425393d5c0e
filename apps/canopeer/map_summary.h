#pragma once

#include "canopeer/map/voxel_map.h"

namespace canopeer::app {

/// What a map holds, on standard output.
void print_map(const VoxelMap& map);

}  // namespace canopeer::app
