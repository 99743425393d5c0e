#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// All triangles of a scene in one piece, with what shading needs per part.
struct SurfaceSoup {
  struct Part {
    Eigen::Vector3f color;  ///< 0 … 255
    PartClass kind = PartClass::structure;
    std::int16_t fruit = -1;
  };

  std::vector<Eigen::Vector3f> vertices;  ///< world
  std::vector<Eigen::Vector3f> normals;   ///< one per vertex
  std::vector<float> brightness;          ///< one per vertex, around 1: no surface is quite even
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> part_of;  ///< per triangle
  std::vector<Part> parts;
};

SurfaceSoup make_surface_soup(const Scene& scene);

}  // namespace canopeer
