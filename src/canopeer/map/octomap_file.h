#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// Files of OctoMap. `.ot` (type OcTree) holds a leaf with its log-odds for every known voxel,
/// equal siblings pruned, inner nodes the maximum of their children; `.bt` holds but free and
/// occupied. The whole file or none. Writing fails beyond OctoMap's ± 32 768 voxels.
[[nodiscard]] Expected<void> write_ot(const VoxelMap& map, const std::filesystem::path& path);
[[nodiscard]] Expected<void> write_bt(const VoxelMap& map, const std::filesystem::path& path);

/// The ROI as a tree of its own; voxels without ROI log-odds are not in it.
[[nodiscard]] Expected<void> write_roi_ot(const VoxelMap& map, const std::filesystem::path& path);
[[nodiscard]] Expected<void> write_roi_bt(const VoxelMap& map, const std::filesystem::path& path);

/// What comes behind the header of such a file of the occupancy: the nodes alone, which is what
/// octomap_msgs/Octomap holds. Empty when the map is. The error: beyond OctoMap's ± 32 768 voxels.
[[nodiscard]] Expected<std::string> ot_nodes(const VoxelMap& map);
[[nodiscard]] Expected<std::string> bt_nodes(const VoxelMap& map);

/// Reads the occupancy of an `.ot` file (types OcTree, OcTreeStamped and ColorOcTree) or of a `.bt`
/// file; which of them it is stands in it. `options.resolution_m` is replaced by the file's; the
/// leaves of a `.bt` file get the log-odds of clamp_min and clamp_max. Every byte is checked; a
/// small file cannot make a huge map.
[[nodiscard]] Expected<VoxelMap> read_octomap(const std::filesystem::path& path,
                                              VoxelMapOptions options = {});

/// Reads such a file's values as the ROI log-odds of `map`, whose resolution must be the file's.
/// After an error the map holds a part of them.
[[nodiscard]] Expected<void> read_octomap_roi(const std::filesystem::path& path, VoxelMap& map);

/// The same from the bytes of a file; errors do not name it.
[[nodiscard]] Expected<VoxelMap> parse_octomap(std::string_view bytes,
                                               VoxelMapOptions options = {});
[[nodiscard]] Expected<void> parse_octomap_roi(std::string_view bytes, VoxelMap& map);

/// True when the bytes begin as an `.ot` or `.bt` file does.
[[nodiscard]] bool is_octomap(std::string_view bytes);

}  // namespace canopeer
