#include "canopeer/robot/robot_description.h"

#include <algorithm>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/robot/convex_corners.h"

namespace canopeer {
namespace {

/// Towards the faces, edges and corners of a cube.
std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) all.push_back(Vec3(x, y, z).normalized());
      }
    }
  }
  return all;
}

}  // namespace

CollisionShape CollisionShape::of_mesh(TriangleMesh triangles, const Pose& T_link_mesh,
                                       std::string file) {
  CANOPEER_CHECK(!triangles.triangles.empty(), "a mesh without triangles is no shape");
  const Box bounds = triangles.bounds();
  const Vec3 centre = bounds.center();
  for (auto& vertex : triangles.vertices) vertex -= centre.cast<float>();
  auto mesh = std::make_shared<ShapeMesh>();
  // Moved vertices are rounded: the solid is laid around the rounded ones.
  Vec3 half = Vec3::Zero();
  for (const auto& vertex : triangles.vertices)
    half = half.cwiseMax(vertex.cast<double>().cwiseAbs());
  for (const Vec3& normal : directions()) {
    ShapeMesh::Plane plane{normal, -std::numeric_limits<double>::infinity()};
    for (const auto& vertex : triangles.vertices)
      plane.offset_m = std::max(plane.offset_m, normal.dot(vertex.cast<double>()));
    mesh->planes.push_back(plane);
  }
  mesh->corners = corners_of(mesh->planes);
  CANOPEER_CHECK(!mesh->corners.empty(), "a bounded solid has corners");
  mesh->file = std::move(file);
  mesh->triangles = std::move(triangles);
  CollisionShape shape;
  shape.kind = ShapeKind::kMesh;
  shape.size_m = 2.0 * half;
  shape.T_link_shape = T_link_mesh * Eigen::Translation3d(centre.cast<float>().cast<double>());
  shape.mesh = std::move(mesh);
  return shape;
}

}  // namespace canopeer
