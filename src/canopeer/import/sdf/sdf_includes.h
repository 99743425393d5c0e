#pragma once

#include <map>
#include <memory>

#include "canopeer/import/sdf/model_paths.h"
#include "canopeer/import/sdf/sdf_file.h"

namespace canopeer {

/// The files that includes lead to; each is read once and lives as long as this.
class SdfIncludes {
 public:
  explicit SdfIncludes(const ModelPaths& paths) : paths_(paths) {}

  /// The file that an <include> means: a model's folder, by its model.config, or a file. Relative
  /// names count from the file that includes. Error: file and line, what is not there, and where it
  /// was looked for.
  [[nodiscard]] Expected<const SdfFile*> find(const SdfElement& include);
  /// Whether there is such a file or folder.
  [[nodiscard]] bool exists(const SdfElement& include) const;

  /// The last part of a model's address, "sun" of "model://sun"; of models on the network in small
  /// letters with "_" for blanks.
  [[nodiscard]] static std::string model_name(const std::string& uri);

 private:
  [[nodiscard]] std::optional<std::filesystem::path> path_of(const SdfElement& include) const;
  Expected<const SdfFile*> read(const std::filesystem::path& path);

  Expected<const SdfFile*> look_up(const SdfElement& include, const std::string& uri);

  const ModelPaths& paths_;
  /// By the folder of the file that includes, and the address there.
  std::map<std::pair<std::filesystem::path, std::string>, const SdfFile*> found_;
  std::map<std::filesystem::path, std::unique_ptr<const SdfFile>> files_;
};

/// The SDF file in a model's folder: of those in model.config the one of the highest version that
/// this reader knows, else the first; without a model.config, model.sdf. Error: there is none.
[[nodiscard]] Expected<std::filesystem::path> sdf_in_model_folder(
    const std::filesystem::path& folder);

}  // namespace canopeer
