#include "canopeer/fruit/surface_files.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/check.h"

namespace canopeer {
namespace {

static_assert(std::endian::native == std::endian::little, "both formats are little-endian");

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(v[axis]));
}

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kVertexData = 34962;
constexpr int kIndexData = 34963;

float to_linear(std::uint8_t level) {
  const double s = level / 255.0;
  return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

/// The triangles of one fruit with vertices of their own.
struct Piece {
  std::map<std::uint32_t, std::uint32_t> place;  ///< of a vertex of the mesh
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> indices;
};

std::map<int, Piece> pieces_of(const SurfaceMesh& mesh) {
  std::map<int, Piece> pieces;
  for (const auto& triangle : mesh.triangles) {
    // A triangle across a border goes to the fruit, not to the rest.
    int fruit = -1;
    for (const std::uint32_t v : triangle) fruit = std::max(fruit, mesh.fruit[v]);
    Piece& piece = pieces[fruit];
    for (const std::uint32_t v : triangle) {
      const auto next = static_cast<std::uint32_t>(piece.vertices.size());
      const auto [entry, is_new] = piece.place.try_emplace(v, next);
      if (is_new) piece.vertices.push_back(v);
      piece.indices.push_back(entry->second);
    }
  }
  return pieces;
}

class GlbWriter {
 public:
  explicit GlbWriter(const SurfaceMesh& mesh) : mesh_(mesh) {}

  std::string write() {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "canopeer"}}},
             {"scene", 0},
             {"scenes", {{{"nodes", Json::array({0})}}}},
             {"materials",
              {{{"name", "fruit"},
                {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}},
                {"doubleSided", true}}}}};
    // World z is up; glTF's y is: the root turns the one into the other.
    Json root = {{"name", "fruits"}, {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}}};
    json_["nodes"] = Json::array({root});
    Json children = Json::array();
    for (const auto& [fruit, piece] : pieces_of(mesh_)) {
      const std::string name = fruit < 0 ? "surface" : "fruit_" + std::to_string(fruit);
      add_piece(name, piece);
      children.push_back(json_["nodes"].size());
      json_["nodes"].push_back({{"name", name}, {"mesh", json_["meshes"].size() - 1}});
    }
    if (!children.empty()) json_["nodes"][0]["children"] = children;
    if (!binary_.empty()) json_["buffers"] = {{{"byteLength", binary_.size()}}};
    return assembled();
  }

 private:
  int add_accessor(const std::string& data, int component, int target, std::size_t count,
                   const char* type) {
    json_["bufferViews"].push_back({{"buffer", 0},
                                    {"byteOffset", binary_.size()},
                                    {"byteLength", data.size()},
                                    {"target", target}});
    binary_ += data;
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  void add_piece(const std::string& name, const Piece& piece) {
    std::string points, normals, colors, indices;
    Eigen::AlignedBox3f bounds;  // of what is written: single precision
    for (const std::uint32_t v : piece.vertices) {
      const SurfaceVertex& vertex = mesh_.vertices[v];
      append(points, vertex.surface.point);
      append(normals, vertex.surface.normal);
      for (const std::uint8_t c : {vertex.color.r, vertex.color.g, vertex.color.b}) {
        append(colors, to_linear(c));
      }
      bounds.extend(Eigen::Vector3f(vertex.surface.point.cast<float>()));
    }
    for (const std::uint32_t i : piece.indices) append(indices, i);
    const std::size_t count = piece.vertices.size();
    const int position = add_accessor(points, kFloat, kVertexData, count, "VEC3");
    Json& described = json_["accessors"][static_cast<std::size_t>(position)];
    described["min"] = {bounds.min().x(), bounds.min().y(), bounds.min().z()};
    described["max"] = {bounds.max().x(), bounds.max().y(), bounds.max().z()};
    const int normal = add_accessor(normals, kFloat, kVertexData, count, "VEC3");
    const int color = add_accessor(colors, kFloat, kVertexData, count, "VEC3");
    const int index =
        add_accessor(indices, kUnsignedInt, kIndexData, piece.indices.size(), "SCALAR");
    Json primitive = {
        {"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"COLOR_0", color}}},
        {"indices", index},
        {"material", 0}};
    json_["meshes"].push_back({{"name", name}, {"primitives", Json::array({primitive})}});
  }

  std::string assembled() {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    const std::size_t binary = binary_.empty() ? 0 : 8 + binary_.size();
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + binary));
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    if (binary_.empty()) return bytes;
    append(bytes, static_cast<std::uint32_t>(binary_.size()));
    bytes.append("BIN\0", 4);
    return bytes + binary_;
  }

  const SurfaceMesh& mesh_;
  std::string binary_;
  Json json_;
};

}  // namespace

Expected<void> write_surface_ply(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  CANOPEER_CHECK(mesh.fruit.size() == mesh.vertices.size(), "one fruit per vertex");
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment canopeer, metres\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int fruit\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const SurfaceVertex& v = mesh.vertices[i];
    append(bytes, v.surface.point);
    append(bytes, v.surface.normal);
    for (const std::uint8_t c : {v.color.r, v.color.g, v.color.b}) append(bytes, c);
    append(bytes, static_cast<std::int32_t>(mesh.fruit[i]));
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t v : triangle) append(bytes, static_cast<std::int32_t>(v));
  }
  return write_file(path, bytes);
}

Expected<void> write_surface_glb(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  CANOPEER_CHECK(mesh.fruit.size() == mesh.vertices.size(), "one fruit per vertex");
  return write_file(path, GlbWriter(mesh).write());
}

}  // namespace canopeer
