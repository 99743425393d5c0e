#pragma once

#include <filesystem>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer::ros {

/// Writes map.ot, map_roi.ot, fruits.csv and fruits.json into `folder`, which is made, and returns
/// what was written. The error is that of the first file that cannot be.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> save_results(
    const std::filesystem::path& folder, const VoxelMap& map,
    const std::vector<FruitEstimate>& fruits);

}  // namespace canopeer::ros
