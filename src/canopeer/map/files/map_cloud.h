#pragma once

#include "canopeer/map/voxel_map.h"
#include "canopeer/sensing/point_cloud.h"

namespace canopeer {

struct MapCloudOptions {
  bool colors = true;  ///< ROI voxels in one colour, the others in another
  Rgb roi{214, 54, 38};
  Rgb other{96, 140, 84};
};

/// The centres of the occupied voxels, world frame, sorted by block, then z, y, x.
PointCloud occupied_cloud(const VoxelMap& map, const MapCloudOptions& options = {});

/// The same of the ROI voxels.
PointCloud roi_cloud(const VoxelMap& map, const MapCloudOptions& options = {});

}  // namespace canopeer
