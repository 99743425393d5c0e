#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/import/meshes/file_mesh.h"
#include "canopeer/import/meshes/texture_file.h"

namespace canopeer {

/// Gives the pieces of one mesh file their colours, textures and the names of those.
class MaterialPainter {
 public:
  /// All outlive the painter. A texture that cannot be read becomes one notice.
  MaterialPainter(const FileMesh& mesh, std::filesystem::path mesh_file, TextureStore& textures,
                  std::vector<std::string>* notices);

  /// Gives `piece` what material `index` says.
  void paint(std::uint32_t index, MeshPiece* piece);

 private:
  struct Paint {
    std::vector<std::string> texture_names;
    std::shared_ptr<const Texture> texture;
  };
  Paint mix(const FileMaterial& material);
  std::shared_ptr<const Texture> load(const FileMaterial& material, const std::string& reference);
  std::shared_ptr<const Texture> load_embedded(const std::string& reference);

  const FileMesh& mesh_;
  std::filesystem::path mesh_file_;
  TextureStore& textures_;
  std::vector<std::string>* notices_;
  std::map<std::uint32_t, Paint> paints_;
  std::map<std::string, std::shared_ptr<const Texture>> embedded_;
};

}  // namespace canopeer
