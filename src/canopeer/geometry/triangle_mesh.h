#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// Indexed triangles, counter-clockwise seen from outside. `normals` is empty or holds one unit
/// vector per vertex.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Appends `other` mapped by T_this_other.
  void append(const TriangleMesh& other, const Pose& T_this_other = Pose::Identity());
  [[nodiscard]] Box bounds() const;
  /// Signed volume by the divergence theorem, m³; meaningful for closed meshes only.
  [[nodiscard]] double volume() const;
  /// Sum of the triangle areas, m².
  [[nodiscard]] double area() const;
};

/// Smooth vertex normals, weighted by triangle area.
void compute_normals(TriangleMesh& mesh);

/// Closed, axis-aligned box.
TriangleMesh make_box(const Box& box);

}  // namespace canopeer
