#include "canopeer/import/meshes/file_mesh.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace canopeer {
namespace {

/// Appends values as they lie in memory.
class Writer {
 public:
  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  /// Elements without padding: floats, indices, colours.
  template <typename T>
  void array(const std::vector<T>& all) {
    value<std::uint64_t>(all.size());
    if (!all.empty())
      bytes_.append(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T));
  }
  void text(const std::string& t) {
    value<std::uint64_t>(t.size());
    bytes_ += t;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what Writer wrote; after the first thing that does not fit, all is empty and good() false.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T value() {
    T v{};
    if (const char* const from = take(sizeof v); from != nullptr) std::memcpy(&v, from, sizeof v);
    return v;
  }
  /// How many of something that takes at least `least_bytes` each.
  std::size_t count(std::size_t least_bytes) {
    const auto n = value<std::uint64_t>();
    if (n > bytes_.size() / least_bytes) good_ = false;
    return good_ ? static_cast<std::size_t>(n) : 0;
  }
  template <typename T>
  std::vector<T> array() {
    std::vector<T> all(count(sizeof(T)));
    if (const char* const from = take(all.size() * sizeof(T)); from != nullptr && !all.empty()) {
      std::memcpy(static_cast<void*>(all.data()), from, all.size() * sizeof(T));
    }
    return all;
  }
  std::string text() {
    const std::size_t n = count(1);
    const char* const from = take(n);
    return from == nullptr ? std::string() : std::string(from, n);
  }
  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

 private:
  const char* take(std::size_t n) {
    if (!good_ || n > bytes_.size()) {
      good_ = false;
      return nullptr;
    }
    const char* const from = bytes_.data();
    bytes_.remove_prefix(n);
    return from;
  }

  std::string_view bytes_;
  bool good_ = true;
};

void write(const MeshPiece& piece, Writer* to) {
  to->array(piece.mesh.vertices);
  to->array(piece.mesh.normals);
  to->array(piece.mesh.triangles);
  to->array(piece.uv);
  to->array(piece.vertex_colors);
  to->text(piece.names.mesh);
  to->text(piece.names.node);
}

MeshPiece read_piece(Reader* from) {
  MeshPiece piece;
  piece.mesh.vertices = from->array<Eigen::Vector3f>();
  piece.mesh.normals = from->array<Eigen::Vector3f>();
  piece.mesh.triangles = from->array<std::array<std::uint32_t, 3>>();
  piece.uv = from->array<Eigen::Vector2f>();
  piece.vertex_colors = from->array<Rgb>();
  piece.names.mesh = from->text();
  piece.names.node = from->text();
  return piece;
}

bool sound(const MeshPiece& piece) {
  const std::size_t n = piece.mesh.vertices.size();
  const auto one_each = [&](std::size_t size) { return size == 0 || size == n; };
  return one_each(piece.mesh.normals.size()) && one_each(piece.uv.size()) &&
         one_each(piece.vertex_colors.size()) &&
         std::all_of(piece.mesh.triangles.begin(), piece.mesh.triangles.end(),
                     [&](const auto& t) { return t[0] < n && t[1] < n && t[2] < n; });
}

void write(const FileMaterial& material, Writer* to) {
  to->text(material.name);
  to->value(material.color);
  to->text(material.picture);
  to->text(material.mask);
  to->value<std::uint8_t>(material.alpha_cuts);
  to->value(material.cut_below);
  to->value<std::uint8_t>(material.see_through);
  to->value<std::uint8_t>(material.tints);
}

FileMaterial read_material(Reader* from) {
  FileMaterial material;
  material.name = from->text();
  material.color = from->value<Rgb>();
  material.picture = from->text();
  material.mask = from->text();
  material.alpha_cuts = from->value<std::uint8_t>() != 0;
  material.cut_below = from->value<std::uint8_t>();
  material.see_through = from->value<std::uint8_t>() != 0;
  material.tints = from->value<std::uint8_t>() != 0;
  return material;
}

}  // namespace

std::string encode(const FileMesh& mesh) {
  Writer to;
  to.value<std::uint64_t>(mesh.parts.size());
  for (const FileMesh::Part& part : mesh.parts) {
    write(part.piece, &to);
    to.value(part.material);
    to.text(part.group);
  }
  to.value<std::uint64_t>(mesh.materials.size());
  for (const FileMaterial& material : mesh.materials) write(material, &to);
  to.value<std::uint64_t>(mesh.pictures.size());
  for (const auto& [reference, bytes] : mesh.pictures) {
    to.text(reference);
    to.text(bytes);
  }
  to.value<std::uint64_t>(mesh.notices.size());
  for (const std::string& notice : mesh.notices) to.text(notice);
  return to.take();
}

Expected<FileMesh> decode_file_mesh(std::string_view bytes) {
  Reader from(bytes);
  FileMesh mesh;
  for (std::size_t n = from.count(8); n > 0 && from.good(); --n) {
    FileMesh::Part part;
    part.piece = read_piece(&from);
    part.material = from.value<std::uint32_t>();
    part.group = from.text();
    if (!sound(part.piece)) return fail("a mesh with corners it does not have");
    mesh.parts.push_back(std::move(part));
  }
  for (std::size_t n = from.count(8); n > 0 && from.good(); --n) {
    mesh.materials.push_back(read_material(&from));
  }
  for (std::size_t n = from.count(8); n > 0 && from.good(); --n) {
    std::string reference = from.text();
    mesh.pictures[std::move(reference)] = from.text();
  }
  for (std::size_t n = from.count(8); n > 0 && from.good(); --n)
    mesh.notices.push_back(from.text());
  if (!from.good() || !from.at_end()) return fail("a mesh that is cut off");
  for (const FileMesh::Part& part : mesh.parts) {
    if (part.material >= mesh.materials.size() && part.material != 0) {
      return fail("a material that is not there");
    }
  }
  return mesh;
}

}  // namespace canopeer
