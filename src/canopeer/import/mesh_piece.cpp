#include "canopeer/import/mesh_piece.h"

#include <limits>
#include <utility>

namespace canopeer {

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
  MeshPiece result;
  result.texture = piece.texture;
  result.color = piece.color;
  result.see_through = piece.see_through;
  result.names = piece.names;
  std::vector<std::uint32_t> index(piece.mesh.vertices.size(), kUnused);
  for (std::size_t i = 0; i < piece.mesh.triangles.size(); ++i) {
    if (keep[i] != value) continue;
    auto triangle = piece.mesh.triangles[i];
    for (auto& corner : triangle) {
      const std::uint32_t old = corner;
      if (index[old] == kUnused) {
        index[old] = static_cast<std::uint32_t>(result.mesh.vertices.size());
        result.mesh.vertices.push_back(piece.mesh.vertices[old]);
        if (!piece.mesh.normals.empty()) result.mesh.normals.push_back(piece.mesh.normals[old]);
        if (!piece.uv.empty()) result.uv.push_back(piece.uv[old]);
        if (!piece.vertex_colors.empty()) {
          result.vertex_colors.push_back(piece.vertex_colors[old]);
        }
      }
      corner = index[old];
    }
    result.mesh.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace canopeer
