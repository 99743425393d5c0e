#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/octomap_msgs.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer::ros {

/// The occupancy as an OcTree: `binary` holds but free and occupied (some 20 times smaller), else
/// every leaf has its log-odds. The error: the map reaches farther than OctoMap can hold.
[[nodiscard]] Expected<octomap_msgs::Octomap> octomap_message(const VoxelMap& map, bool binary,
                                                              const std_msgs::Header& header);

}  // namespace canopeer::ros
