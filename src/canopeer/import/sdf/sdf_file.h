#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/import/sdf/sdf_element.h"

namespace canopeer {

/// The newest SDF whose worlds this reader knows.
inline constexpr SdfVersion kNewestSdf{1, 12};

/// "1.6". Nothing: it is no version.
[[nodiscard]] std::optional<SdfVersion> to_sdf_version(std::string_view text);

/// An SDF file as it stands; its elements point into it. Not for two threads at once, though const:
/// the library makes sense of a text when it is first asked for.
class SdfFile {
 public:
  /// Error: the file, the line, and what is no sound XML there, or which root stands in place of
  /// <sdf>. Without a version it counts as the newest.
  [[nodiscard]] static Expected<std::unique_ptr<const SdfFile>> parse(std::string_view text,
                                                                      std::filesystem::path path);
  [[nodiscard]] static Expected<std::unique_ptr<const SdfFile>> read(
      const std::filesystem::path& path);

  SdfFile(const SdfFile&) = delete;
  SdfFile& operator=(const SdfFile&) = delete;
  ~SdfFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] SdfVersion version() const { return version_; }
  /// <sdf>, or <robot>, which is URDF.
  [[nodiscard]] SdfElement root() const;
  [[nodiscard]] bool is_urdf() const { return root().tag() == "robot"; }

 private:
  struct Document;
  SdfFile(std::filesystem::path path, std::unique_ptr<const Document> document);

  std::filesystem::path path_;
  std::unique_ptr<const Document> document_;
  SdfVersion version_ = kNewestSdf;
};

}  // namespace canopeer
