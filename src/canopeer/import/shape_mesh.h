#pragma once

#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

// The primitive shapes of SDF as triangles, about their own centre, with normals. Round ones have
// 32 sides: a cylinder of 5 cm is 0.2 mm off.

[[nodiscard]] TriangleMesh box_mesh(const Vec3& size_m);
[[nodiscard]] TriangleMesh ellipsoid_mesh(const Vec3& radii_m);
[[nodiscard]] TriangleMesh cylinder_mesh(double radius_m, double length_m);
/// Its tip is at z = `length_m` / 2.
[[nodiscard]] TriangleMesh cone_mesh(double radius_m, double length_m);
/// `length_m`: of the cylinder between the two half spheres.
[[nodiscard]] TriangleMesh capsule_mesh(double radius_m, double length_m);
/// A rectangle square to `normal`.
[[nodiscard]] TriangleMesh plane_mesh(const Vec3& normal, double width_m, double height_m);

}  // namespace canopeer
