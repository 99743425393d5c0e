#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/point_cloud.h"

namespace canopeer {

/// A point cloud as a file gives it.
struct CloudFile {
  PointCloud cloud;
  /// The property `roi` of each point, 0 … 1 (whole numbers: 0 or not); empty when the file has
  /// none. NaN: nobody looked.
  std::vector<float> roi_confidence;
  /// The property `fruit` of each point: its number, −1 for none; empty when the file has none.
  std::vector<int> fruit;
  /// What a PCD file's VIEWPOINT says; nothing when that is the default, which writers put there
  /// when they know no pose.
  std::optional<Pose> T_world_points;
  /// What was guessed, and what was passed over that a user may miss; each names the file.
  std::vector<std::string> notices;
};

/// Reads PLY (ASCII, binary of either byte order), PCD (ASCII, binary, compressed) or a table as
/// text (`.csv`, `.tsv`, `.txt`, `.xyz`, `.asc`, `.pts`), by the content, else by the ending. Of
/// all properties x, y, z, normals, colours, `roi` and `fruit` are kept. Points may be NaN. The
/// error names the file and, in text, the line. Memory stays in proportion to the file.
[[nodiscard]] Expected<CloudFile> read_cloud(const std::filesystem::path& path);

/// True for `.ply` and `.pcd`, in small letters or capitals.
[[nodiscard]] bool is_cloud_of_scanner(const std::filesystem::path& path);

/// The same from the bytes of a file; `name` stands for it in errors.
[[nodiscard]] Expected<CloudFile> parse_ply(std::string_view bytes, const std::string& name);
[[nodiscard]] Expected<CloudFile> parse_pcd(std::string_view bytes, const std::string& name);
/// A table: UTF-8 or UTF-16; commas, semicolons, tabs, bars or blanks between columns; decimal
/// points, or commas where something else separates; quotes. A line or comment (#, //, %) names the
/// columns, or there are x, y, z and what leaves no doubt (see the notices).
[[nodiscard]] Expected<CloudFile> parse_csv_cloud(std::string_view bytes, const std::string& name);

}  // namespace canopeer
