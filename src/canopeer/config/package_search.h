#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace canopeer {

/// Finds ROS packages by name. A package is a folder of that name, or one whose package.xml says
/// the name. Looked for in the folders given, with what lies in them and in their `share` (a
/// workspace, an installed prefix), in the folders above the file that asks, and beside those.
class PackageSearch {
 public:
  /// `directory`: where the asking file lies. `given`: folders that hold packages, or are one.
  PackageSearch(const std::filesystem::path& directory,
                const std::vector<std::filesystem::path>& given);

  /// Folders that may be the package, the likeliest first; empty: none. `thorough`: those too that
  /// have other names or lie deeper, for which package.xml files are read.
  [[nodiscard]] std::vector<std::filesystem::path> folders_of(const std::string& name,
                                                              bool thorough);

  /// The folders it starts from, in the order in which they are looked at.
  [[nodiscard]] const std::vector<std::filesystem::path>& starts() const { return starts_; }
  /// The folders above the asking file, itself first.
  [[nodiscard]] std::vector<std::filesystem::path> above() const;
  /// Of the packages there are, the one whose name is nearest; empty: none is near.
  [[nodiscard]] std::string nearest(const std::string& name);

 private:
  [[nodiscard]] std::string name_in(const std::filesystem::path& folder);
  void collect();
  void collect_below(const std::filesystem::path& folder, int depth);

  std::vector<std::filesystem::path> starts_;
  std::size_t given_ = 0;  // the first so many of them were given
  bool collected_ = false;
  int folders_left_ = 20000;  // a whole disk is not searched
  std::map<std::filesystem::path, std::string> names_;
  std::map<std::string, std::vector<std::filesystem::path>, std::less<>> by_name_;
};

}  // namespace canopeer
