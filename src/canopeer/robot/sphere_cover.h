#pragma once

#include <vector>

#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// A ball that covers a part of a link.
struct Sphere {
  Vec3 centre = Vec3::Zero();  ///< link frame
  double radius_m = 0.0;
};

/// Spheres that together hold every point of `shape`, in the link's frame. Cylinder: a row along
/// the axis, sticking out of the mantle by at most `max_excess_m` (> 0) unless one sphere is enough
/// anyway. Box: one sphere around each of cells that are about as long as the box is thin. Mesh:
/// slices of its convex solid across the longest edge of the bounding box, a sphere around each.
/// Boxes thicker than 0.12 m and meshes thicker than 0.025 m are cut across too. At most some
/// thousand spheres, whatever the size.
[[nodiscard]] std::vector<Sphere> cover_with_spheres(const CollisionShape& shape,
                                                     double max_excess_m);

/// A sphere around all of `spheres` (not empty).
[[nodiscard]] Sphere bounding_sphere(const std::vector<Sphere>& spheres);

/// Signed distance from `p_shape` (shape frame) to the shape's surface, negative inside. Exact, but
/// for meshes: there a lower bound, of the convex solid around the mesh.
[[nodiscard]] double signed_distance(const CollisionShape& shape, const Vec3& p_shape);

/// A lower bound on the distance between the shape and a cube of half edge `half_m` around
/// `p_shape`, with its axes along the columns of `R_shape_cube`. Negative: they may touch. It comes
/// from the plane that holds the shape back from the cube's centre, so it is exact where the two
/// face each other.
[[nodiscard]] double cube_distance(const CollisionShape& shape, const Vec3& p_shape,
                                   const Eigen::Matrix3d& R_shape_cube, double half_m);

/// How well spheres cover a solid.
struct CoverQuality {
  double solid_m3 = 0.0;    ///< volume of the shapes together
  double spheres_m3 = 0.0;  ///< volume of the spheres together
  double excess_m = 0.0;    ///< farthest a sphere sticks out of the shapes
  [[nodiscard]] double overhead() const {
    return solid_m3 > 0.0 ? spheres_m3 / solid_m3 - 1.0 : 0.0;
  }
};

/// Measured on a grid of about `samples` points around the spheres; shapes in the link's frame.
[[nodiscard]] CoverQuality measure_cover(const std::vector<CollisionShape>& shapes,
                                         const std::vector<Sphere>& spheres, int samples = 200000);

}  // namespace canopeer
