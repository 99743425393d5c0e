#pragma once

#include <filesystem>
#include <string>

namespace canopeer::test {

/// A fresh directory of a test's own, removed at the end.
class WorldFiles {
 public:
  WorldFiles();
  ~WorldFiles();
  WorldFiles(const WorldFiles&) = delete;
  WorldFiles& operator=(const WorldFiles&) = delete;

  /// Writes a file, with the folders it needs; returns its path.
  std::filesystem::path add(const std::string& name, const std::string& content) const;
  /// A model folder under models/ with one link whose body is `link_content`.
  void add_model(const std::string& name, const std::string& link_content,
                 const std::string& under = "models") const;
  /// `content` inside <sdf><world name="test">, as world.world.
  std::filesystem::path add_world(const std::string& content,
                                  const std::string& version = "1.6") const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path models() const { return path_ / "models"; }

 private:
  std::filesystem::path path_;
};

/// <visual> with a mesh.
std::string mesh_visual(const std::string& uri, const std::string& more = "");
/// <visual> with a box.
std::string box_visual(const std::string& size, const std::string& more = "");

}  // namespace canopeer::test
