#pragma once

#include <vector>

#include "canopeer/robot/robot_description.h"

namespace canopeer {

struct Sphere {
  Vec3 centre = Vec3::Zero();  ///< link frame
  double radius_m = 0.0;
};

/// Spheres that together hold every point of `shape`, in the link's frame. Cylinder: a row along
/// the axis, sticking out of the mantle by at most `max_excess_m` (> 0) unless one sphere is enough
/// anyway. Box: one sphere around each of cells that are about as long as the box is thin.
[[nodiscard]] std::vector<Sphere> cover_with_spheres(const CollisionShape& shape,
                                                     double max_excess_m);

/// A sphere around all of `spheres` (not empty).
[[nodiscard]] Sphere bounding_sphere(const std::vector<Sphere>& spheres);

/// Signed distance from `p_shape` (shape frame) to the shape's surface, negative inside; exact.
[[nodiscard]] double signed_distance(const CollisionShape& shape, const Vec3& p_shape);

}  // namespace canopeer
