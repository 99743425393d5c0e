#include "canopeer/import/meshes/mesh_piece.h"

#include <array>
#include <bit>
#include <limits>
#include <unordered_map>
#include <utility>

namespace canopeer {
namespace {

/// All that makes a vertex: position, normal, texture coordinates, colour.
using VertexKey = std::array<std::uint32_t, 9>;

struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t h = 0;
    for (const std::uint32_t word : key) h = (h ^ word) * 0x9e3779b97f4a7c15ULL + (h >> 31);
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

VertexKey key_of(const MeshPiece& piece, std::size_t i) {
  VertexKey key{};
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    key[at] = std::bit_cast<std::uint32_t>(piece.mesh.vertices[i][k]);
    if (!piece.mesh.normals.empty()) {
      key[3 + at] = std::bit_cast<std::uint32_t>(piece.mesh.normals[i][k]);
    }
  }
  if (!piece.uv.empty()) {
    key[6] = std::bit_cast<std::uint32_t>(piece.uv[i].x());
    key[7] = std::bit_cast<std::uint32_t>(piece.uv[i].y());
  }
  if (!piece.vertex_colors.empty()) {
    const Rgb& c = piece.vertex_colors[i];
    key[8] = (std::uint32_t{c.r} << 16) + (std::uint32_t{c.g} << 8) + c.b;
  }
  return key;
}

/// All of a piece but its surface.
MeshPiece without_surface(const MeshPiece& piece) {
  MeshPiece result;
  result.texture = piece.texture;
  result.color = piece.color;
  result.see_through = piece.see_through;
  result.names = piece.names;
  return result;
}

void copy_vertex(const MeshPiece& from, std::size_t i, MeshPiece& to) {
  to.mesh.vertices.push_back(from.mesh.vertices[i]);
  if (!from.mesh.normals.empty()) to.mesh.normals.push_back(from.mesh.normals[i]);
  if (!from.uv.empty()) to.uv.push_back(from.uv[i]);
  if (!from.vertex_colors.empty()) to.vertex_colors.push_back(from.vertex_colors[i]);
}

}  // namespace

MeshPiece without_copies(const MeshPiece& piece) {
  MeshPiece result = without_surface(piece);
  std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> known;
  known.reserve(piece.mesh.vertices.size());
  std::vector<std::uint32_t> index;
  for (std::size_t i = 0; i < piece.mesh.vertices.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(result.mesh.vertices.size());
    index.push_back(known.emplace(key_of(piece, i), next).first->second);
    if (index.back() == next) copy_vertex(piece, i, result);
  }
  for (const auto& t : piece.mesh.triangles) {
    result.mesh.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  }
  return result;
}

MeshPiece placed(const MeshPiece& piece, const Eigen::Affine3d& T_world_piece) {
  MeshPiece result = piece;
  for (auto& v : result.mesh.vertices) v = (T_world_piece * v.cast<double>()).cast<float>();
  // Normals follow the inverse transpose, or a stretched sphere would be lit like a round one.
  const Eigen::Matrix3d linear = T_world_piece.linear();
  const double volume = linear.determinant();
  if (volume == 0.0) {
    result.mesh.normals.clear();
    return result;
  }
  const Eigen::Matrix3d turn = linear.inverse().transpose();
  for (auto& n : result.mesh.normals) n = (turn * n.cast<double>()).normalized().cast<float>();
  if (volume < 0.0) {
    for (auto& t : result.mesh.triangles) std::swap(t[1], t[2]);
  }
  return result;
}

MeshPiece selected(const MeshPiece& piece, const std::vector<int>& keep, int value) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  MeshPiece result = without_surface(piece);
  std::vector<std::uint32_t> index(piece.mesh.vertices.size(), kUnused);
  for (std::size_t i = 0; i < piece.mesh.triangles.size(); ++i) {
    if (keep[i] != value) continue;
    auto triangle = piece.mesh.triangles[i];
    for (auto& corner : triangle) {
      const std::uint32_t old = corner;
      if (index[old] == kUnused) {
        index[old] = static_cast<std::uint32_t>(result.mesh.vertices.size());
        copy_vertex(piece, old, result);
      }
      corner = index[old];
    }
    result.mesh.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace canopeer
