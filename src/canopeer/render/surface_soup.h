#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// All triangles of a scene in one piece, with what shading needs per part.
struct SurfaceSoup {
  struct Part {
    Eigen::Vector3f color;  ///< 0 … 255
    PartClass kind = PartClass::structure;
    std::int16_t fruit = -1;
    std::shared_ptr<const Texture> texture;  ///< null: none
    bool vertex_colors = false;              ///< `colors` holds, not `color`
  };

  std::vector<Eigen::Vector3f> vertices;  ///< world
  std::vector<Eigen::Vector3f> normals;   ///< one per vertex
  std::vector<float> brightness;          ///< one per vertex, around 1: no surface is quite even
  /// Per vertex, empty when no part needs them.
  std::vector<Eigen::Vector2f> uv;
  std::vector<Eigen::Vector3f> colors;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint32_t first_cut = 0;         ///< triangles from here on have a texture with holes
  std::vector<std::uint32_t> part_of;  ///< per triangle
  std::vector<Part> parts;
};

/// What a camera can see of the scene.
SurfaceSoup make_surface_soup(const Scene& scene);

/// Weights of a triangle's three vertices at a hit.
struct Barycentric {
  float u = 0.0F;  ///< of the second vertex
  float v = 0.0F;  ///< of the third
};

/// Colour of a surface point before light, grey levels 0 … 255.
Eigen::Vector3f base_color(const SurfaceSoup& soup, std::uint32_t triangle, Barycentric at);

/// False where a texture cuts a hole.
bool solid(const SurfaceSoup& soup, std::uint32_t triangle, Barycentric at);

}  // namespace canopeer
