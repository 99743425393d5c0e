#include "canopeer/import/scene_glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/meshes/gltf_constants.h"
#include "canopeer/import/meshes/texture_file.h"

namespace canopeer {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

double to_linear(std::uint8_t level) {
  const double s = level / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

class GlbWriter {
 public:
  explicit GlbWriter(const Scene& scene) : scene_(scene) {}
  Expected<std::string> write();

 private:
  int add_view(const void* data, std::size_t bytes, int target);
  int add_vectors(const std::vector<Eigen::Vector3f>& vectors, bool bounds);
  Expected<int> add_texture(const std::shared_ptr<const Texture>& texture);
  Expected<int> add_material(const ScenePart& part);
  Expected<int> add_mesh(const ScenePart& part, const std::string& name);
  int add_node(const std::string& name, int mesh);
  Expected<void> add_parts(Json* roots);
  Expected<void> add_copies(Json* roots);
  [[nodiscard]] std::string material_name(const ScenePart& part) const;
  [[nodiscard]] std::string group_of(const ScenePart& part) const;
  void name_plants();

  const Scene& scene_;
  std::string binary_;
  Json json_ = {{"asset", {{"version", "2.0"}, {"generator", "canopeer"}}}};
  std::map<const Texture*, int> textures_;
  std::map<std::pair<std::string, const Texture*>, int> materials_;
  std::map<int, std::string> plant_names_;
};

void GlbWriter::name_plants() {
  for (const FruitTruth& fruit : scene_.fruits) {
    if (!fruit.model.empty()) plant_names_.emplace(fruit.plant, fruit.model);
  }
}

std::string GlbWriter::group_of(const ScenePart& part) const {
  if (part.plant < 0) return "glasshouse";
  const auto known = plant_names_.find(part.plant);
  return known != plant_names_.end() ? known->second : "plant_" + std::to_string(part.plant);
}

std::string GlbWriter::material_name(const ScenePart& part) const {
  std::string name = part_class_name(part.kind);
  if (part.fruit >= 0 && scene_.fruits[static_cast<std::size_t>(part.fruit)].counted) {
    name += "_counted";
  }
  return name;
}

int GlbWriter::add_view(const void* data, std::size_t bytes, int target) {
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}};
  if (target != 0) view["target"] = target;
  binary_.append(static_cast<const char*>(data), bytes);
  json_["bufferViews"].push_back(view);
  return static_cast<int>(json_["bufferViews"].size()) - 1;
}

/// Positions or normals; z up becomes y up.
int GlbWriter::add_vectors(const std::vector<Eigen::Vector3f>& vectors, bool bounds) {
  std::vector<Eigen::Vector3f> turned;
  Eigen::AlignedBox3f box;
  for (const auto& v : vectors) {
    turned.emplace_back(v.x(), v.z(), -v.y());
    box.extend(turned.back());
  }
  Json accessor = {
      {"bufferView", add_view(turned.data(), turned.size() * sizeof(turned[0]), gltf::kVertexData)},
      {"componentType", gltf::kFloat},
      {"count", turned.size()},
      {"type", "VEC3"}};
  if (bounds) {
    accessor["min"] = {box.min().x(), box.min().y(), box.min().z()};
    accessor["max"] = {box.max().x(), box.max().y(), box.max().z()};
  }
  json_["accessors"].push_back(accessor);
  return static_cast<int>(json_["accessors"].size()) - 1;
}

Expected<int> GlbWriter::add_texture(const std::shared_ptr<const Texture>& texture) {
  if (const auto known = textures_.find(texture.get()); known != textures_.end()) {
    return known->second;
  }
  const auto png = encode_texture(*texture);
  if (!png) return tl::unexpected(png.error());
  const int view = add_view(png->data(), png->size(), 0);
  const std::string name = std::filesystem::path(texture->name).filename().string();
  json_["images"].push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
  json_["textures"].push_back({{"source", json_["images"].size() - 1}});
  const int index = static_cast<int>(json_["textures"].size()) - 1;
  textures_[texture.get()] = index;
  return index;
}

Expected<int> GlbWriter::add_material(const ScenePart& part) {
  const bool textured = part.texture != nullptr && !part.texture->color.empty();
  const Texture* const texture = textured ? part.texture.get() : nullptr;
  const std::string name = material_name(part);
  const bool painted = textured || !part.vertex_colors.empty();
  const Rgb c = painted ? Rgb{255, 255, 255} : part.color;
  const std::string key =
      name + (part.see_through ? "/glass" : "") + std::to_string(c.r * 65536 + c.g * 256 + c.b);
  if (const auto known = materials_.find({key, texture}); known != materials_.end()) {
    return known->second;
  }
  Json surface = {{"baseColorFactor",
                   {to_linear(c.r), to_linear(c.g), to_linear(c.b), part.see_through ? 0.2 : 1.0}},
                  {"metallicFactor", 0.0},
                  {"roughnessFactor", 0.9}};
  if (textured) {
    const auto index = add_texture(part.texture);
    if (!index) return tl::unexpected(index.error());
    surface["baseColorTexture"] = {{"index", *index}};
  }
  Json material = {{"name", name}, {"pbrMetallicRoughness", surface}, {"doubleSided", true}};
  if (textured && part.texture->cuts()) {
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = part.texture->cut_below / 255.0;
  } else if (part.see_through) {
    material["alphaMode"] = "BLEND";
  }
  json_["materials"].push_back(material);
  const int index = static_cast<int>(json_["materials"].size()) - 1;
  materials_[{key, texture}] = index;
  return index;
}

/// What a part is called: fruits by their number in the ground truth, the others by their own.
std::string name_of(const ScenePart& part, int first_fruit, std::size_t index) {
  if (part.fruit >= 0) return "fruit_" + std::to_string(first_fruit + part.fruit);
  const std::string kind = part_class_name(part.kind);
  return (part.kind == PartClass::fruit ? "fruit_part" : kind) + "_" + std::to_string(index);
}

/// Column by column, z up turned into y up on both sides.
Json matrix_of(const Pose& T) {
  Eigen::Matrix4d up = Eigen::Matrix4d::Identity();  // x right, y up, z towards us
  up.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Eigen::Matrix4d M = up * T.matrix() * up.transpose();
  return std::vector<double>(M.data(), M.data() + 16);
}

/// Index of the part's mesh.
Expected<int> GlbWriter::add_mesh(const ScenePart& part, const std::string& name) {
  const auto material = add_material(part);
  if (!material) return tl::unexpected(material.error());
  const TriangleMesh& mesh = part.mesh;
  Json attributes;
  attributes["POSITION"] = add_vectors(mesh.vertices, true);
  if (mesh.normals.size() == mesh.vertices.size()) {
    attributes["NORMAL"] = add_vectors(mesh.normals, false);
  }
  const auto add_accessor = [&](int view, int component, std::size_t count, const char* type,
                                bool normalized) {
    Json accessor = {
        {"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    json_["accessors"].push_back(accessor);
    return static_cast<int>(json_["accessors"].size()) - 1;
  };
  if (part.texture != nullptr && part.uv.size() == mesh.vertices.size()) {
    std::vector<Eigen::Vector2f> uv;
    for (const auto& p : part.uv) uv.emplace_back(p.x(), 1.0F - p.y());  // glTF counts v downwards
    attributes["TEXCOORD_0"] =
        add_accessor(add_view(uv.data(), uv.size() * sizeof(uv[0]), gltf::kVertexData),
                     gltf::kFloat, uv.size(), "VEC2", false);
  }
  if (!part.vertex_colors.empty()) {
    std::string colors;
    for (const Rgb& c : part.vertex_colors) {
      colors += {static_cast<char>(c.r), static_cast<char>(c.g), static_cast<char>(c.b), '\xff'};
    }
    attributes["COLOR_0"] =
        add_accessor(add_view(colors.data(), colors.size(), gltf::kVertexData), gltf::kUnsignedByte,
                     part.vertex_colors.size(), "VEC4", true);
  }
  const int indices =
      add_accessor(add_view(mesh.triangles.data(),
                            mesh.triangles.size() * sizeof(mesh.triangles[0]), gltf::kIndexData),
                   gltf::kUnsignedInt, 3 * mesh.triangles.size(), "SCALAR", false);
  json_["meshes"].push_back({{"name", name},
                             {"primitives", Json::array({{{"attributes", attributes},
                                                          {"indices", indices},
                                                          {"material", *material}}})}});
  return static_cast<int>(json_["meshes"].size()) - 1;
}

int GlbWriter::add_node(const std::string& name, int mesh) {
  json_["nodes"].push_back({{"name", name}, {"mesh", mesh}});
  return static_cast<int>(json_["nodes"].size()) - 1;
}

Expected<void> GlbWriter::add_parts(Json* roots) {
  std::vector<std::string> order;
  std::map<std::string, Json> children;
  for (std::size_t i = 0; i < scene_.parts.size(); ++i) {
    const ScenePart& part = scene_.parts[i];
    if (part.mesh.triangles.empty()) continue;
    const std::string group = group_of(part);
    const std::string name = name_of(part, 0, i);
    const auto mesh = add_mesh(part, name);
    if (!mesh) return tl::unexpected(mesh.error());
    if (children.count(group) == 0) order.push_back(group);
    children[group].push_back(add_node(name, *mesh));
  }
  for (const std::string& group : order) {
    json_["nodes"].push_back({{"name", group}, {"children", children[group]}});
    roots->push_back(json_["nodes"].size() - 1);
  }
  return {};
}

/// Copies share their model's meshes.
Expected<void> GlbWriter::add_copies(Json* roots) {
  std::vector<std::vector<int>> meshes(scene_.models.size());
  for (std::size_t m = 0; m < scene_.models.size(); ++m) {
    const auto first = std::find_if(scene_.instances.begin(), scene_.instances.end(),
                                    [&](const SceneInstance& copy) { return copy.model == m; });
    if (first == scene_.instances.end()) continue;
    for (ScenePart part : scene_.models[m].parts) {
      if (part.fruit >= 0) part.fruit += first->first_fruit;  // all copies' fruits count alike
      const auto mesh =
          add_mesh(part, "model_" + std::to_string(m) + "_" + part_class_name(part.kind));
      if (!mesh) return tl::unexpected(mesh.error());
      meshes[m].push_back(*mesh);
    }
  }
  for (const SceneInstance& copy : scene_.instances) {
    Json children = Json::array();
    const std::vector<ScenePart>& parts = scene_.models[copy.model].parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      children.push_back(add_node(name_of(parts[i], copy.first_fruit, i), meshes[copy.model][i]));
    }
    json_["nodes"].push_back({{"name", "plant_" + std::to_string(copy.plant)},
                              {"matrix", matrix_of(copy.T_world_model)},
                              {"children", children}});
    roots->push_back(json_["nodes"].size() - 1);
  }
  return {};
}

Expected<std::string> GlbWriter::write() {
  name_plants();
  Json roots = Json::array();
  if (auto ok = add_parts(&roots); !ok) return tl::unexpected(ok.error());
  if (auto ok = add_copies(&roots); !ok) return tl::unexpected(ok.error());
  json_["scenes"] = Json::array({{{"name", scene_.name}, {"nodes", roots}}});
  json_["scene"] = 0;
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  if (!binary_.empty()) json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  // Names in files are not always UTF-8; what is not becomes a question mark.
  std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string glb;
  const auto add_word = [&](std::uint32_t word) {
    glb.append(reinterpret_cast<const char*>(&word), sizeof word);
  };
  add_word(gltf::kMagic);
  add_word(2);
  add_word(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary_.size()));
  add_word(static_cast<std::uint32_t>(text.size()));
  add_word(gltf::kJsonChunk);
  glb += text;
  add_word(static_cast<std::uint32_t>(binary_.size()));
  add_word(gltf::kBinaryChunk);
  glb += binary_;
  return glb;
}

}  // namespace

Expected<void> write_scene_glb(const std::filesystem::path& path, const Scene& scene) {
  const auto glb = GlbWriter(scene).write();
  if (!glb) return fail_in(path.string(), glb.error());
  return write_file(path, *glb);
}

}  // namespace canopeer
