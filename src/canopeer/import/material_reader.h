#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "canopeer/import/mesh_piece.h"
#include "canopeer/import/texture_file.h"

struct aiMaterial;
struct aiScene;

namespace canopeer {

/// What colours mean differs between formats: glTF's material colours are linear and multiply
/// vertex colours; viewers of COLLADA show no vertex colours.
enum class MaterialDialect { plain, collada, gltf };

/// Colours, textures and their names of one assimp scene's materials.
class MaterialReader {
 public:
  /// All outlive the reader. A texture that cannot be read becomes one notice.
  MaterialReader(const aiScene& scene, std::filesystem::path mesh_file, TextureStore& textures,
                 std::vector<std::string>* notices);

  void set_dialect(MaterialDialect dialect) { dialect_ = dialect; }

  /// Gives `piece` what material `index` says.
  void paint(unsigned index, MeshPiece* piece);

 private:
  struct Material {
    std::string name;
    std::vector<std::string> texture_names;
    Rgb color{180, 180, 180};
    std::shared_ptr<const Texture> texture;
  };
  Material read(const aiMaterial& material);
  std::shared_ptr<const Texture> load(const aiMaterial& material, const std::string& reference);
  std::shared_ptr<const Texture> load_embedded(const std::string& reference);

  const aiScene& scene_;
  std::filesystem::path mesh_file_;
  MaterialDialect dialect_ = MaterialDialect::plain;
  TextureStore& textures_;
  std::vector<std::string>* notices_;
  std::map<unsigned, Material> materials_;
  std::map<std::string, std::shared_ptr<const Texture>> embedded_;
};

}  // namespace canopeer
