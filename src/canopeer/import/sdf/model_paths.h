#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace canopeer {

/// Turns what a world refers to into files.
class ModelPaths {
 public:
  /// `roots`: folders with one folder a model, as Gazebo's model path; in order of preference.
  /// `fuel_caches`: where programs of Gazebo keep what they fetched, "~/.gz/fuel".
  explicit ModelPaths(std::vector<std::filesystem::path> roots,
                      std::vector<std::filesystem::path> fuel_caches = {});

  /// `model://name/…` and `package://name/…` under the roots, `https://…` under the roots by the
  /// model's name and then in the caches, `file://…` and absolute paths as they are, anything else
  /// relative to `folder` (of the file that refers to it). Percent-encoded or not. Nothing when no
  /// such file or folder exists.
  [[nodiscard]] std::optional<std::filesystem::path> find(
      const std::string& uri, const std::filesystem::path& folder) const;

  /// "searched: …", for messages; of the network also what to do.
  [[nodiscard]] std::string searched(const std::string& uri,
                                     const std::filesystem::path& folder) const;

 private:
  [[nodiscard]] std::vector<std::filesystem::path> candidates(
      const std::string& uri, const std::filesystem::path& folder) const;
  std::vector<std::filesystem::path> roots_;
  std::vector<std::filesystem::path> fuel_caches_;
};

}  // namespace canopeer
