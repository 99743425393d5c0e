#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// Our own map files (`.cmap`): options, occupancy and ROI log-odds, all exact. Groups of blocks
/// are compressed and checksummed one by one; layout: docs/formats.md. Reading back what was
/// written gives the same map. The whole file is written, or none.
[[nodiscard]] Expected<void> write_cmap(const VoxelMap& map, const std::filesystem::path& path);

/// Every byte is checked before it is used. Memory grows with what was checked: a file of n bytes
/// cannot hold more than n / 8 blocks.
[[nodiscard]] Expected<VoxelMap> read_cmap(const std::filesystem::path& path);

/// The same from and to the bytes of a file; errors do not name it.
[[nodiscard]] std::string cmap_bytes(const VoxelMap& map);
[[nodiscard]] Expected<VoxelMap> parse_cmap(std::string_view bytes);

/// True when the bytes begin as a `.cmap` file does.
[[nodiscard]] bool is_cmap(std::string_view bytes);

}  // namespace canopeer
