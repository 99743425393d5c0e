#pragma once

#include <memory>
#include <string>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// By what names a piece of surface is known in the files it comes from. Empty: it has none.
struct PartNames {
  std::string material;
  std::vector<std::string> textures;  ///< file names without folder
  std::string mesh;                   ///< of the geometry
  std::string node;                   ///< that the geometry hangs on
  std::string file;                   ///< mesh file without folder
  std::string visual;                 ///< of an SDF world
  std::string link;
  std::string model;  ///< all the way down: "row::plant_3"
};

/// One material's share of a mesh.
struct MeshPiece {
  TriangleMesh mesh;
  std::vector<Eigen::Vector2f> uv;  ///< one per vertex, or empty
  std::vector<Rgb> vertex_colors;   ///< one per vertex, or empty
  std::shared_ptr<const Texture> texture;
  Rgb color{180, 180, 180};
  bool see_through = false;
  PartNames names;
};

/// `piece` mapped by an affine map; one that mirrors turns the triangles round, so that outside
/// stays outside.
[[nodiscard]] MeshPiece placed(const MeshPiece& piece, const Eigen::Affine3d& T_world_piece);

/// The same surface with vertices that agree in every bit made one: most files give each triangle
/// its own.
[[nodiscard]] MeshPiece without_copies(const MeshPiece& piece);

/// The triangles of `piece` for which `keep[i]` is `value`, with the vertices they need.
[[nodiscard]] MeshPiece selected(const MeshPiece& piece, const std::vector<int>& keep, int value);

}  // namespace canopeer
