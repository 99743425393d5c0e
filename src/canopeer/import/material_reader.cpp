#include "canopeer/import/material_reader.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// First texture of the first of `types` that has one; empty: none.
std::string first_texture(const aiMaterial& material, std::initializer_list<aiTextureType> types) {
  for (const aiTextureType type : types) {
    aiString path;
    if (material.GetTextureCount(type) > 0 &&
        material.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0) {
      return path.C_Str();
    }
  }
  return {};
}

/// "file:///a%20b\c.png" → "/a b/c.png".
std::string plain_path(std::string reference) {
  if (reference.starts_with("file://")) reference.erase(0, 7);
  std::replace(reference.begin(), reference.end(), '\\', '/');
  std::string plain;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const auto hex = [&](std::size_t k) {
      return k < reference.size() && std::isxdigit(static_cast<unsigned char>(reference[k])) != 0;
    };
    if (reference[i] == '%' && hex(i + 1) && hex(i + 2)) {
      plain += static_cast<char>(std::stoi(reference.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      plain += reference[i];
    }
  }
  return plain;
}

/// Where model folders keep their textures, seen from the mesh.
std::optional<fs::path> find_texture(const fs::path& mesh_file, const std::string& reference) {
  const fs::path given = plain_path(reference);
  const fs::path dir = mesh_file.parent_path();
  for (const fs::path& candidate :
       {given.is_absolute() ? given : dir / given, dir / given.filename(),
        dir / "../materials/textures" / given.filename(), dir / "../textures" / given.filename(),
        dir / "textures" / given.filename()}) {
    std::error_code code;
    if (fs::is_regular_file(candidate, code)) return candidate;
  }
  return std::nullopt;
}

std::uint8_t level(float x) {
  return static_cast<std::uint8_t>(std::clamp(x >= 0.0F ? x : 0.0F, 0.0F, 1.0F) * 255.0F + 0.5F);
}

/// A linear share of light as an sRGB level.
std::uint8_t srgb_level(float x) {
  x = std::clamp(x >= 0.0F ? x : 0.0F, 0.0F, 1.0F);
  return level(x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F);
}

Rgb product(Rgb a, Rgb b) {
  const auto scaled = [](int x, int y) { return static_cast<std::uint8_t>((x * y + 127) / 255); };
  return {scaled(a.r, b.r), scaled(a.g, b.g), scaled(a.b, b.b)};
}

Image<std::uint8_t> grey_of(const ColorImage& color) {
  Image<std::uint8_t> grey(color.width(), color.height());
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    const Rgb& c = color.pixels()[i];
    grey.pixels()[i] = static_cast<std::uint8_t>((c.r + c.g + c.b) / 3);
  }
  return grey;
}

/// glTF says whether alpha means anything and where it cuts; elsewhere a picture's alpha cuts.
struct AlphaRule {
  bool cuts = true;
  std::uint8_t cut_below = 128;
};

AlphaRule alpha_rule(const aiMaterial& material) {
  AlphaRule rule;
  aiString mode;
  if (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) != aiReturn_SUCCESS) return rule;
  rule.cuts = std::string(mode.C_Str()) != "OPAQUE";
  float cutoff = 0.5F;
  if (std::string(mode.C_Str()) == "MASK" &&
      material.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff) == aiReturn_SUCCESS) {
    rule.cut_below = std::max<std::uint8_t>(level(cutoff), 1);
  }
  return rule;
}

/// Colour from one picture, opacity from another (or the same, or none) under the alpha rule.
std::shared_ptr<const Texture> combined(const std::shared_ptr<const Texture>& color,
                                        const std::shared_ptr<const Texture>& mask,
                                        const AlphaRule& rule) {
  if (color == nullptr && mask == nullptr) return nullptr;
  const bool own_alpha = color != nullptr && !color->opacity.empty();
  if (mask == nullptr && (!own_alpha || (rule.cuts && rule.cut_below == color->cut_below))) {
    return color;  // shared as it is
  }
  Texture texture;
  if (color != nullptr) texture = *color;
  texture.cut_below = rule.cut_below;
  if (!rule.cuts) texture.opacity = {};
  if (mask != nullptr) {
    texture.opacity = mask->opacity.empty() ? grey_of(mask->color) : mask->opacity;
    if (texture.name.empty()) texture.name = mask->name;
  }
  return std::make_shared<const Texture>(std::move(texture));
}

}  // namespace

MaterialReader::MaterialReader(const aiScene& scene, fs::path mesh_file, TextureStore& textures,
                               std::vector<std::string>* notices)
    : scene_(scene), mesh_file_(std::move(mesh_file)), textures_(textures), notices_(notices) {}

std::shared_ptr<const Texture> MaterialReader::load_embedded(const std::string& reference) {
  if (const auto known = embedded_.find(reference); known != embedded_.end()) return known->second;
  std::shared_ptr<const Texture> result;
  const aiTexture* const texture = scene_.GetEmbeddedTexture(reference.c_str());
  // Height 0: a whole picture file of mWidth bytes.
  if (texture != nullptr && texture->mHeight == 0) {
    const std::string_view bytes(reinterpret_cast<const char*>(texture->pcData), texture->mWidth);
    if (auto decoded = decode_texture(bytes, mesh_file_.string() + reference); decoded) {
      result = std::make_shared<const Texture>(std::move(*decoded));
    } else {
      notices_->push_back(decoded.error().message + "; going on without this texture");
    }
  }
  return embedded_.emplace(reference, result).first->second;
}

std::shared_ptr<const Texture> MaterialReader::load(const aiMaterial& material,
                                                    const std::string& reference) {
  if (reference.empty()) return nullptr;
  if (scene_.GetEmbeddedTexture(reference.c_str()) != nullptr) return load_embedded(reference);
  const auto path = find_texture(mesh_file_, reference);
  const std::string from = "; material '" + std::string(material.GetName().C_Str()) + "' in " +
                           mesh_file_.string() + " refers to it; going on without this texture";
  if (!path) {
    notices_->push_back("texture " + reference + ": not found" + from);
    return nullptr;
  }
  const auto texture = textures_.get(*path);
  if (!texture) {
    notices_->push_back("texture " + texture.error().message + from);
    return nullptr;
  }
  return *texture;
}

MaterialReader::Material MaterialReader::read(const aiMaterial& material) {
  Material result;
  result.name = material.GetName().C_Str();
  aiColor4D color;
  if (material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
    result.color = dialect_ == MaterialDialect::gltf
                       ? Rgb{srgb_level(color.r), srgb_level(color.g), srgb_level(color.b)}
                       : Rgb{level(color.r), level(color.g), level(color.b)};
  }
  const std::string picture =
      first_texture(material, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  std::string mask = first_texture(material, {aiTextureType_OPACITY});
  for (const std::string& name : {picture, mask}) {
    if (name.empty()) continue;
    result.texture_names.push_back(fs::path(plain_path(name)).filename().string());
  }
  if (mask == picture) mask.clear();
  // One after the other: the order of notices is that of the file.
  const auto color_texture = load(material, picture);
  const auto mask_texture = load(material, mask);
  result.texture = combined(color_texture, mask_texture, alpha_rule(material));
  return result;
}

void MaterialReader::paint(unsigned index, MeshPiece* piece) {
  if (index >= scene_.mNumMaterials) return;
  auto known = materials_.find(index);
  if (known == materials_.end()) {
    known = materials_.emplace(index, read(*scene_.mMaterials[index])).first;
  }
  const Material& material = known->second;
  piece->names.material = material.name;
  piece->names.textures = material.texture_names;
  piece->color = material.color;
  if (dialect_ == MaterialDialect::collada) piece->vertex_colors.clear();
  if (dialect_ == MaterialDialect::gltf) {
    for (Rgb& c : piece->vertex_colors) c = product(c, material.color);
  }
  if (piece->uv.empty()) return;
  piece->texture = material.texture;
}

}  // namespace canopeer
