#include "canopeer/import/meshes/plain_gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/meshes/gltf_constants.h"
#include "canopeer/import/meshes/gltf_container.h"
#include "canopeer/import/meshes/gltf_extensions.h"
#include "canopeer/import/meshes/gltf_numbers.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kTransform = "KHR_texture_transform";

/// glTF 1.0 keeps by name what later versions number.
bool is_first_version(const json& file) {
  const auto meshes = file.find("meshes");
  const json asset = file.value("asset", json::object());
  const auto version = asset.find("version");
  return (meshes != file.end() && meshes->is_object()) ||
         (version != asset.end() && version->is_string() &&
          version->get<std::string>().starts_with('1'));
}

/// Where a texture takes its coordinates from.
struct Coordinates {
  std::size_t set = 0;
  double u0 = 0.0, v0 = 0.0, turn_rad = 0.0, su = 1.0, sv = 1.0;

  [[nodiscard]] bool moved() const {
    return u0 != 0.0 || v0 != 0.0 || turn_rad != 0.0 || su != 1.0 || sv != 1.0;
  }
};

Coordinates coordinates_of(const json& texture) {
  Coordinates result;
  result.set = texture.value("texCoord", std::size_t{0});
  const json extensions = texture.value("extensions", json::object());
  const auto transform = extensions.find(kTransform);
  if (transform == extensions.end()) return result;
  result.set = transform->value("texCoord", result.set);
  const auto offset = transform->value("offset", std::array{0.0, 0.0});
  const auto scale = transform->value("scale", std::array{1.0, 1.0});
  result.u0 = offset[0];
  result.v0 = offset[1];
  result.su = scale[0];
  result.sv = scale[1];
  result.turn_rad = transform->value("rotation", 0.0);
  return result;
}

/// KHR_texture_transform: scaled, turned, moved.
void move(const Coordinates& to, std::vector<float>* uv) {
  const double c = std::cos(to.turn_rad);
  const double s = std::sin(to.turn_rad);
  for (std::size_t i = 0; i + 1 < uv->size(); i += 2) {
    const double u = to.su * (*uv)[i];
    const double v = to.sv * (*uv)[i + 1];
    (*uv)[i] = static_cast<float>(to.u0 + c * u + s * v);
    (*uv)[i + 1] = static_cast<float>(to.v0 - s * u + c * v);
  }
}

class Plainer {
 public:
  explicit Plainer(const fs::path& path) : path_(path) {}
  std::string say();

 private:
  void name_sources();
  void use_diffuse();
  void look_at_buffers();
  void plain_primitive(json* primitive);
  void plain_attribute(const char* name, json* attributes);
  void place_texture(json* primitive);
  void drop_other_coordinates(json* attributes);
  std::size_t add_numbers(const std::vector<float>& numbers, std::size_t width);
  const std::vector<std::string>& buffers();
  [[nodiscard]] std::string merged();

  const fs::path& path_;
  json file_;
  std::string binary_;
  std::optional<std::vector<std::string>> buffers_;
  std::string added_;
  std::map<std::size_t, std::size_t> plain_;  ///< accessor of whole numbers → one of floats
  bool changed_ = false;
};

const std::vector<std::string>& Plainer::buffers() {
  if (buffers_) return *buffers_;
  buffers_.emplace();
  for (const json& buffer : file_.value("buffers", json::array())) {
    if (buffer.contains("uri")) {
      buffers_->push_back(bytes_behind(buffer.at("uri").get<std::string>(), path_.parent_path()));
    } else {
      buffers_->push_back(buffers_->empty() ? binary_ : std::string());
    }
  }
  return *buffers_;
}

/// Index of a new accessor.
std::size_t Plainer::add_numbers(const std::vector<float>& numbers, std::size_t width) {
  const std::size_t bytes = numbers.size() * sizeof(float);
  json& views = file_["bufferViews"];
  views.push_back(
      {{"buffer", buffers().size()}, {"byteOffset", added_.size()}, {"byteLength", bytes}});
  added_.append(reinterpret_cast<const char*>(numbers.data()), bytes);
  json& accessors = file_["accessors"];
  accessors.push_back({{"bufferView", views.size() - 1},
                       {"componentType", gltf::kFloat},
                       {"count", numbers.size() / width},
                       {"type", width == 2 ? "VEC2" : "VEC3"}});
  changed_ = true;
  return accessors.size() - 1;
}

/// Pictures that a format's extension names in place of the plain source.
void Plainer::name_sources() {
  if (!file_.contains("textures")) return;
  for (json& texture : file_["textures"]) {
    const json extensions = texture.value("extensions", json::object());
    for (const auto& [name, extension] : extensions.items()) {
      if (texture.contains("source") || !extension.contains("source")) continue;
      texture["source"] = extension["source"];
      changed_ = true;
    }
  }
}

/// The older workflow's diffuse colour is the base colour of surfaces that are no metal.
void Plainer::use_diffuse() {
  if (!file_.contains("materials")) return;
  for (json& material : file_["materials"]) {
    const json extensions = material.value("extensions", json::object());
    const auto old = extensions.find("KHR_materials_pbrSpecularGlossiness");
    json base = material.value("pbrMetallicRoughness", json::object());
    if (old == extensions.end() || base.contains("baseColorFactor") ||
        base.contains("baseColorTexture")) {
      continue;
    }
    if (old->contains("diffuseFactor")) base["baseColorFactor"] = old->at("diffuseFactor");
    if (old->contains("diffuseTexture")) base["baseColorTexture"] = old->at("diffuseTexture");
    material["pbrMetallicRoughness"] = base;
    changed_ = true;
  }
}

/// The library takes names of buffers as they are, and binary glTF by the file's name.
void Plainer::look_at_buffers() {
  for (const json& buffer : file_.value("buffers", json::array())) {
    const std::string uri = buffer.value("uri", std::string());
    if (!uri.starts_with("data:") && uri.find('%') != std::string::npos) changed_ = true;
  }
}

void Plainer::plain_attribute(const char* name, json* attributes) {
  const auto attribute = attributes->find(name);
  if (attribute == attributes->end()) return;
  const auto index = attribute->get<std::size_t>();
  const json& accessor = file_.at("accessors").at(index);
  if (accessor.at("componentType").get<int>() == gltf::kFloat && !accessor.contains("sparse"))
    return;
  auto known = plain_.find(index);
  if (known == plain_.end()) {
    const std::size_t width = std::string_view(name).starts_with("TEXCOORD") ? 2 : 3;
    const auto numbers = gltf_numbers(file_, buffers(), index, width);
    known = plain_.emplace(index, add_numbers(numbers, width)).first;
  }
  (*attributes)[name] = known->second;
}

/// Brings the coordinates of the base colour's picture into the first set.
void Plainer::place_texture(json* primitive) {
  const auto material = primitive->find("material");
  if (material == primitive->end()) return;
  const json& surface = file_.at("materials").at(material->get<std::size_t>());
  const json base = surface.value("pbrMetallicRoughness", json::object());
  const auto texture = base.find("baseColorTexture");
  if (texture == base.end()) return;
  const Coordinates coordinates = coordinates_of(*texture);
  json& attributes = primitive->at("attributes");
  const std::string set = "TEXCOORD_" + std::to_string(coordinates.set);
  if ((coordinates.set == 0 && !coordinates.moved()) || !attributes.contains(set)) return;
  auto uv = gltf_numbers(file_, buffers(), attributes.at(set).get<std::size_t>(), 2);
  move(coordinates, &uv);
  attributes["TEXCOORD_0"] = add_numbers(uv, 2);
}

void Plainer::plain_primitive(json* primitive) {
  json& attributes = primitive->at("attributes");
  check_packing(file_, *primitive);
  for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"}) plain_attribute(name, &attributes);
  place_texture(primitive);
  if (!attributes.contains("TEXCOORD_0")) drop_other_coordinates(&attributes);
}

/// The library refuses a second set without a first.
void Plainer::drop_other_coordinates(json* attributes) {
  for (int set = 1; attributes->erase("TEXCOORD_" + std::to_string(set)) > 0; ++set) {
    changed_ = true;
  }
}

/// One buffer of all.
std::string Plainer::merged() {
  std::vector<std::size_t> begins;
  std::string all;
  const auto add = [&](const std::string& bytes) {
    all.resize((all.size() + 3) / 4 * 4, '\0');
    begins.push_back(all.size());
    all += bytes;
  };
  for (const std::string& buffer : buffers()) add(buffer);
  add(added_);
  for (json& view : file_["bufferViews"]) {
    const auto buffer = view.at("buffer").get<std::size_t>();
    view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + begins.at(buffer);
    view["buffer"] = 0;
  }
  file_["buffers"] = json::array({{{"byteLength", all.size()}}});
  return to_glb({file_.dump(-1, ' ', false, json::error_handler_t::replace), all});
}

std::string Plainer::say() {
  const auto bytes = read_file(path_);
  if (!bytes) throw std::runtime_error(bytes.error().message);
  if (is_old_binary_gltf(*bytes)) return {};
  GltfContainer container = read_gltf_container(*bytes);
  binary_ = std::move(container.binary);
  file_ = json::parse(container.json);
  if (is_first_version(file_)) return {};
  check_needed_extensions(file_);
  const bool named_binary = path_.extension() == ".glb" || path_.extension() == ".GLB";
  changed_ = bytes->starts_with("glTF") != named_binary || !container.aligned;
  look_at_buffers();
  name_sources();
  use_diffuse();
  if (file_.contains("meshes")) {
    for (json& mesh : file_["meshes"]) {
      for (json& primitive : mesh.at("primitives")) plain_primitive(&primitive);
    }
  }
  return changed_ ? merged() : std::string();
}

}  // namespace

std::string plain_gltf(const fs::path& path) {
  try {
    return Plainer(path).say();
  } catch (const json::parse_error& error) {
    throw std::runtime_error("its JSON breaks off or is damaged at byte " +
                             std::to_string(error.byte));
  } catch (const std::out_of_range&) {
    throw std::runtime_error("glTF with a buffer that is not there");
  } catch (const json::exception&) {
    throw std::runtime_error("its JSON is no glTF: a member is missing or of the wrong kind");
  }
}

}  // namespace canopeer
