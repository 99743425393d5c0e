#include "canopeer/import/meshes/material_painter.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "canopeer/base/percent_encoding.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// "file:///a%20b\c.png " → "/a b/c.png".
std::string plain_path(std::string reference) {
  constexpr const char* kBlanks = " \t\r\n";  // some formats' readers leave those at the end
  reference.erase(reference.find_last_not_of(kBlanks) + 1);
  if (reference.starts_with("file://")) reference.erase(0, 7);
  std::replace(reference.begin(), reference.end(), '\\', '/');
  return percent_decoded(reference);
}

/// The file in `folder` that `name` means but for capitals, which mean nothing on Windows.
std::optional<fs::path> find_but_for_capitals(const fs::path& folder, const std::string& name) {
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  std::optional<fs::path> found;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string other = entry.path().filename().string();
    if (!std::equal(name.begin(), name.end(), other.begin(), other.end(), same)) continue;
    if (!found || entry.path() < *found) found = entry.path();
  }
  return found;
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
  for (const char* folder : {".", "../materials/textures", "../textures", "textures"}) {
    const auto found = find_but_for_capitals(dir / folder, given.filename().string());
    if (found) return found->lexically_normal();
  }
  return std::nullopt;
}

Image<std::uint8_t> grey_of(const ColorImage& color) {
  Image<std::uint8_t> grey(color.width(), color.height());
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    const Rgb& c = color.pixels()[i];
    grey.pixels()[i] = static_cast<std::uint8_t>((c.r + c.g + c.b) / 3);
  }
  return grey;
}

double to_light(double level) {
  const double s = level / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::uint8_t to_level(double light) {
  const double s = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(std::clamp(s, 0.0, 1.0) * 255.0));
}

/// Each pixel's light times that of `tint`.
void multiply(ColorImage* image, Rgb tint) {
  const auto table = [](std::uint8_t share) {
    std::array<std::uint8_t, 256> levels{};
    for (std::size_t i = 0; i < levels.size(); ++i) {
      levels[i] = to_level(to_light(static_cast<double>(i)) * to_light(share));
    }
    return levels;
  };
  const auto red = table(tint.r);
  const auto green = table(tint.g);
  const auto blue = table(tint.b);
  for (Rgb& c : image->pixels()) c = {red[c.r], green[c.g], blue[c.b]};
}

/// Colour from one picture, opacity from another (or the same, or none) under the alpha rule.
std::shared_ptr<const Texture> combined(const std::shared_ptr<const Texture>& color,
                                        const std::shared_ptr<const Texture>& mask,
                                        const FileMaterial& rule) {
  if (color == nullptr && mask == nullptr) return nullptr;
  const bool own_alpha = color != nullptr && !color->opacity.empty();
  const bool tints = color != nullptr && rule.tints;
  if (mask == nullptr && !tints &&
      (!own_alpha || (rule.alpha_cuts && rule.cut_below == color->cut_below))) {
    return color;  // shared as it is
  }
  Texture texture;
  if (color != nullptr) texture = *color;
  if (tints) multiply(&texture.color, rule.color);
  texture.cut_below = rule.cut_below;
  if (!rule.alpha_cuts) texture.opacity = {};
  if (mask != nullptr) {
    texture.opacity = mask->opacity.empty() ? grey_of(mask->color) : mask->opacity;
    if (texture.name.empty()) texture.name = mask->name;
  }
  return std::make_shared<const Texture>(std::move(texture));
}

}  // namespace

MaterialPainter::MaterialPainter(const FileMesh& mesh, fs::path mesh_file, TextureStore& textures,
                                 std::vector<std::string>* notices)
    : mesh_(mesh), mesh_file_(std::move(mesh_file)), textures_(textures), notices_(notices) {}

std::shared_ptr<const Texture> MaterialPainter::load_embedded(const std::string& reference) {
  if (const auto known = embedded_.find(reference); known != embedded_.end()) return known->second;
  std::shared_ptr<const Texture> result;
  auto decoded = decode_texture(mesh_.pictures.at(reference), mesh_file_.string() + reference);
  if (decoded) {
    result = std::make_shared<const Texture>(std::move(*decoded));
  } else {
    notices_->push_back(decoded.error().message + "; going on without this texture");
  }
  return embedded_.emplace(reference, result).first->second;
}

std::shared_ptr<const Texture> MaterialPainter::load(const FileMaterial& material,
                                                     const std::string& reference) {
  if (reference.empty()) return nullptr;
  if (mesh_.pictures.count(reference) != 0) return load_embedded(reference);
  const auto path = find_texture(mesh_file_, reference);
  const std::string from = "; material '" + material.name + "' in " + mesh_file_.string() +
                           " refers to it; going on without this texture";
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

MaterialPainter::Paint MaterialPainter::mix(const FileMaterial& material) {
  Paint paint;
  for (const std::string& name : {material.picture, material.mask}) {
    if (name.empty()) continue;
    paint.texture_names.push_back(fs::path(plain_path(name)).filename().string());
  }
  // One after the other: the order of notices is that of the file.
  const auto color = load(material, material.picture);
  const auto mask = load(material, material.mask);
  paint.texture = combined(color, mask, material);
  return paint;
}

void MaterialPainter::paint(std::uint32_t index, MeshPiece* piece) {
  if (index >= mesh_.materials.size()) return;
  const FileMaterial& material = mesh_.materials[index];
  auto known = paints_.find(index);
  if (known == paints_.end()) known = paints_.emplace(index, mix(material)).first;
  piece->names.material = material.name;
  piece->names.textures = known->second.texture_names;
  piece->color = material.color;
  piece->see_through = material.see_through;
  if (!piece->uv.empty()) piece->texture = known->second.texture;
}

}  // namespace canopeer
