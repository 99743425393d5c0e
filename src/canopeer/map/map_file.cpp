#include "canopeer/map/map_file.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/map/cmap_file.h"
#include "canopeer/map/files/map_cloud.h"
#include "canopeer/map/octomap_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

Expected<void> write_occupied_ply(const VoxelMap& map, const fs::path& path) {
  return write_ply(path, occupied_cloud(map));
}

Expected<void> write_roi_ply(const VoxelMap& map, const fs::path& path) {
  return write_ply(path, roi_cloud(map));
}

struct Writer {
  using Write = Expected<void> (*)(const VoxelMap&, const fs::path&);
  std::string_view ending;
  Write occupancy;
  Write roi;  // nullptr: in the same file
};

constexpr std::array<Writer, 4> kWriters = {{{".cmap", &write_cmap, nullptr},
                                             {".ot", &write_ot, &write_roi_ot},
                                             {".bt", &write_bt, &write_roi_bt},
                                             {".ply", &write_occupied_ply, &write_roi_ply}}};

Expected<Writer> writer_for(const fs::path& path) {
  const std::string ending = path.extension().string();
  const auto found = std::find_if(kWriters.begin(), kWriters.end(),
                                  [&](const Writer& writer) { return writer.ending == ending; });
  if (found == kWriters.end()) {
    return fail(path.string() + ": cannot tell the format from the ending \"" + ending +
                "\"; expected .cmap, .ot, .bt or .ply");
  }
  return *found;
}

// Any ROI log-odds: blocks whose ROI was never touched answer fast.
bool has_roi(const VoxelMap& map) {
  if (map.roi_voxels() > 0) return true;
  for (const BlockKey key : map.block_keys()) {
    bool found = false;
    for_each_voxel(key, VoxelMask::all(),
                   [&](const VoxelIndex& voxel) { found |= map.roi_log_odds(voxel) != 0.0; });
    if (found) return true;
  }
  return false;
}

}  // namespace

fs::path roi_file_of(const fs::path& path) {
  return path.parent_path() / (path.stem().string() + "_roi" + path.extension().string());
}

Expected<MapFile> read_map(const fs::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  if (is_cmap(*bytes)) {
    auto map = parse_cmap(*bytes);
    if (!map) return fail_in(path.string(), map.error());
    return MapFile{*std::move(map), "canopeer map (.cmap)", {path}};
  }
  if (!is_octomap(*bytes)) {
    return fail(path.string() +
                ": neither a canopeer map (.cmap) nor an OctoMap file (.ot, .bt) by its content");
  }
  auto map = parse_octomap(*bytes);
  if (!map) return fail_in(path.string(), map.error());
  MapFile file{*std::move(map), "OctoMap", {path}};
  const fs::path roi = roi_file_of(path);
  std::error_code code;
  if (fs::exists(roi, code)) {
    if (auto read = read_octomap_roi(roi, file.map); !read) return tl::unexpected(read.error());
    file.files.push_back(roi);
  }
  return file;
}

Expected<std::vector<fs::path>> write_map(const VoxelMap& map, const fs::path& path) {
  const auto writer = writer_for(path);
  if (!writer) return tl::unexpected(writer.error());
  if (auto done = writer->occupancy(map, path); !done) return tl::unexpected(done.error());
  std::vector<fs::path> files = {path};
  const fs::path roi = roi_file_of(path);
  std::error_code code;
  if (writer->roi != nullptr && (has_roi(map) || fs::exists(roi, code))) {
    if (auto done = writer->roi(map, roi); !done) return tl::unexpected(done.error());
    files.push_back(roi);
  }
  return files;
}

Expected<void> check_map_destination(const fs::path& path) {
  if (const auto writer = writer_for(path); !writer) return tl::unexpected(writer.error());
  const fs::path directory = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code code;
  if (!fs::is_directory(directory, code)) {
    return fail(path.string() + ": the directory " + directory.string() + " is not there; make it");
  }
  if (fs::is_directory(path, code)) return fail(path.string() + ": is a directory");
  return {};
}

}  // namespace canopeer
