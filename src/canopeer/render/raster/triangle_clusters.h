#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "canopeer/render/surfaces/surface_soup.h"

namespace canopeer {

/// The triangles of a soup in small groups that lie close together: what the rasteriser culls,
/// sorts and draws. A group has triangles of one part only.
struct TriangleClusters {
  static constexpr std::size_t kMaxTriangles = 64;
  static constexpr std::size_t kMaxVertices = 3 * kMaxTriangles;
  /// Vertices of a group are padded to a multiple of this, with copies of its last one.
  static constexpr std::size_t kPadding = 16;

  struct Cluster {
    Eigen::Vector3f centre;  ///< of the box around its vertices
    Eigen::Vector3f half;    ///< half its edges, rounded up
    std::uint32_t first_vertex = 0;
    std::uint32_t first_triangle = 0;
    std::uint8_t vertices = 0;  ///< padding counted
    std::uint8_t triangles = 0;
    bool cut = false;  ///< its texture has holes
  };

  std::vector<Cluster> clusters;
  /// Vertices of all groups, frame of the soup.
  std::vector<float> x, y, z;
  /// Per triangle: its corners among the vertices of its group, and its number in the soup.
  std::vector<std::array<std::uint8_t, 3>> corners;
  std::vector<std::uint32_t> triangles;
  Box bounds;  ///< around everything; empty when there is nothing
};

/// The same soup gives the same groups on every machine.
TriangleClusters make_triangle_clusters(const SurfaceSoup& soup);

}  // namespace canopeer
