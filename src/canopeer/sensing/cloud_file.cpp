#include "canopeer/sensing/cloud_file.h"

#include <algorithm>
#include <array>
#include <string>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

enum class Kind { none, ply, pcd, table };

Kind kind_of_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  constexpr std::array<std::string_view, 8> kTables = {".csv", ".tsv", ".txt",  ".xyz",
                                                       ".asc", ".pts", ".xyzn", ".xyzrgb"};
  if (ending == ".ply") return Kind::ply;
  if (ending == ".pcd") return Kind::pcd;
  return std::find(kTables.begin(), kTables.end(), ending) != kTables.end() ? Kind::table
                                                                            : Kind::none;
}

/// What else a file may hold, by its first bytes.
std::string other_content(std::string_view bytes) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kBeginnings = {
      {{"version https://git-lfs", "a Git LFS pointer, not the file; run `git lfs pull`"},
       {"\x1F\x8B", "compressed by gzip; unpack it first"},
       {"PK\x03\x04", "a ZIP archive; unpack it first"},
       {"LASF", "a LAS or LAZ cloud; convert it to PLY"},
       {"ASTM-E57", "an E57 cloud; convert it to PLY"},
       {"glTF", "a glTF mesh, no cloud"},
       {"<?xml", "XML, no cloud"},
       {"<!DOCTYPE", "a web page, no cloud"},
       {"\x89PNG", "a picture, no cloud"}}};
  for (const auto& [beginning, what] : kBeginnings) {
    if (bytes.starts_with(beginning)) return std::string(what);
  }
  return {};
}

}  // namespace

bool is_cloud_of_scanner(const std::filesystem::path& path) {
  const Kind kind = kind_of_ending(path);
  return kind == Kind::ply || kind == Kind::pcd;
}

Expected<CloudFile> read_cloud(const std::filesystem::path& path) {
  const Kind kind = kind_of_ending(path);
  if (kind == Kind::none) {
    return fail(path.string() +
                ": expected a point cloud file (.ply, .pcd or .csv; as text also .txt, .xyz, .asc, "
                ".pts)");
  }
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  if (const std::string other = other_content(*bytes); !other.empty()) {
    return fail(path.string() + ": is " + other);
  }
  if (bytes->starts_with("ply\n") || bytes->starts_with("ply\r") || kind == Kind::ply) {
    return parse_ply(*bytes, path.string());
  }
  if (bytes->starts_with("# .PCD") || kind == Kind::pcd) return parse_pcd(*bytes, path.string());
  return parse_csv_cloud(*bytes, path.string());
}

}  // namespace canopeer
