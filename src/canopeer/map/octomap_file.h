#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// Writes the occupancy as an OctoMap `.ot` file (id OcTree): a leaf with its log-odds for every
/// free or occupied voxel, equal siblings pruned, inner nodes the maximum of their children. The
/// whole file or none. Fails beyond OctoMap's ± 32 768 voxels.
[[nodiscard]] Expected<void> write_ot(const VoxelMap& map, const std::filesystem::path& path);

/// The ROI log-odds as a tree of their own; voxels that never held an end point are not in it.
[[nodiscard]] Expected<void> write_roi_ot(const VoxelMap& map, const std::filesystem::path& path);

/// Reads the occupancy of an `.ot` file; `options.resolution_m` is replaced by the file's
/// resolution. Fails on a file that is cut off or holds no OcTree.
[[nodiscard]] Expected<VoxelMap> read_ot(const std::filesystem::path& path,
                                         VoxelMapOptions options = {});

}  // namespace canopeer
