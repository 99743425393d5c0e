#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// All triangles of a scene, or of one of its models, in one piece, with what shading needs per
/// part.
struct SurfaceSoup {
  struct Part {
    Eigen::Vector3f color;  ///< 0 … 255
    PartClass kind = PartClass::structure;
    std::int16_t fruit = -1;
    std::shared_ptr<const Texture> texture;  ///< null: none
    bool vertex_colors = false;              ///< `colors` holds, not `color`
  };

  std::vector<Eigen::Vector3f> vertices;  ///< world, or the model's frame
  /// What shading needs of a vertex, in one place: a ray's three lie anywhere in memory.
  struct Finish {
    Eigen::Vector3f normal;
    float brightness = 1.0F;  ///< around 1: no surface is quite even
  };
  std::vector<Finish> finish;  ///< one per vertex
  /// Per vertex, empty when no part needs them.
  std::vector<Eigen::Vector2f> uv;
  std::vector<Eigen::Vector3f> colors;
  struct Triangle {
    std::array<std::uint32_t, 3> vertex{};
    std::uint32_t part = 0;
  };
  std::vector<Triangle> triangles;
  std::uint32_t first_cut = 0;  ///< triangles from here on have a texture with holes
  std::vector<Part> parts;
};

/// Its texture has holes.
bool has_holes(const ScenePart& part);

/// What a camera can see of these parts: in their order those without holes, then those with.
SurfaceSoup make_surface_soup(const std::vector<ScenePart>& parts);

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
