#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// A map in any format the project reads.
struct MapFile {
  VoxelMap map;
  std::string format;                        ///< in words, for people
  std::vector<std::filesystem::path> files;  ///< what was read: the map, and its ROI tree if apart
};

/// `name_roi.ot` beside `name.ot`: where formats that hold one tree (.ot, .bt, .ply) keep the ROI.
[[nodiscard]] std::filesystem::path roi_file_of(const std::filesystem::path& path);

/// Reads `.cmap`, `.ot` or `.bt`, known by their content; with an OctoMap file also the ROI tree
/// beside it when there is one.
[[nodiscard]] Expected<MapFile> read_map(const std::filesystem::path& path);

/// Writes the format the ending names: `.cmap`; `.ot` or `.bt` with the ROI tree beside it; `.ply`
/// (centres of occupied voxels, and of ROI voxels beside). A file for the ROI is written when the
/// map has one or when an older one lies there. Returns what was written.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> write_map(
    const VoxelMap& map, const std::filesystem::path& path);

/// An error when the ending names no format, or the file's directory is not there. Ask before a
/// long computation whose result goes to `path`.
[[nodiscard]] Expected<void> check_map_destination(const std::filesystem::path& path);

}  // namespace canopeer
