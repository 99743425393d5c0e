#include "canopeer/import/meshes/file_material_reader.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

constexpr float kLeastSeen = 0.5F;  // opacity below which a camera looks through

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

std::uint8_t level(float x) {
  return static_cast<std::uint8_t>(std::clamp(x >= 0.0F ? x : 0.0F, 0.0F, 1.0F) * 255.0F + 0.5F);
}

/// A linear share of light as an sRGB level.
std::uint8_t srgb_level(float x) {
  x = std::clamp(x >= 0.0F ? x : 0.0F, 0.0F, 1.0F);
  return level(x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F);
}

/// glTF says whether alpha means anything and where it cuts; elsewhere a picture's alpha cuts.
void read_alpha_rule(const aiMaterial& material, FileMaterial* result) {
  aiString mode;
  if (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) != aiReturn_SUCCESS) return;
  result->alpha_cuts = std::string(mode.C_Str()) != "OPAQUE";
  float cutoff = 0.5F;
  if (std::string(mode.C_Str()) == "MASK" &&
      material.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff) == aiReturn_SUCCESS) {
    result->cut_below = std::max<std::uint8_t>(level(cutoff), 1);
  }
}

/// How opaque the material as a whole is, 0 … 1, where the format leaves no doubt.
float opacity_of(const aiMaterial& material, const FileMaterial& read, MaterialDialect dialect) {
  float opacity = 1.0F;
  aiColor4D color;
  switch (dialect) {
    case MaterialDialect::gltf:
      if (read.alpha_cuts && material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS) {
        return color.a;
      }
      return 1.0F;
    case MaterialDialect::plain:
      return material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS ? opacity : 1.0F;
    case MaterialDialect::collada:
      return 1.0F;  // writers disagree on whether 0 or 1 is clear; see opacity_in_doubt()
  }
  return 1.0F;
}

}  // namespace

FileMaterial read_file_material(const aiMaterial& material, MaterialDialect dialect) {
  FileMaterial result;
  result.name = material.GetName().C_Str();
  aiColor4D color;
  if (material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
    result.color = dialect == MaterialDialect::gltf
                       ? Rgb{srgb_level(color.r), srgb_level(color.g), srgb_level(color.b)}
                       : Rgb{level(color.r), level(color.g), level(color.b)};
  }
  result.picture = first_texture(material, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  result.mask = first_texture(material, {aiTextureType_OPACITY});
  if (result.mask == result.picture) result.mask.clear();
  result.tints = dialect == MaterialDialect::gltf &&
                 material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS &&
                 !(result.color == Rgb{255, 255, 255});
  read_alpha_rule(material, &result);
  result.see_through = opacity_of(material, result, dialect) < kLeastSeen;
  return result;
}

std::string opacity_in_doubt(const aiMaterial& material, MaterialDialect dialect) {
  float opacity = 1.0F;
  if (dialect != MaterialDialect::collada ||
      material.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS || opacity >= kLeastSeen) {
    return {};
  }
  return std::string("material '") + material.GetName().C_Str() +
         "' may be meant to be clear; programs disagree on what COLLADA's <transparency> means, so "
         "it is solid here; give its visual a <transparency>, or leave it out with a skip pattern";
}

}  // namespace canopeer
