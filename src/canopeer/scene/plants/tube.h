#pragma once

#include <vector>

#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

/// A point on the axis of something round.
struct AxisPoint {
  Vec3 position = Vec3::Zero();
  double radius_m = 0.0;
};

/// Closed tube around an axis of at least two distinct points, with normals. The cross-section is
/// carried along without twisting.
TriangleMesh make_tube(const std::vector<AxisPoint>& axis, int sides);

/// Cubic Bézier curve at t in [0, 1].
Vec3 bezier(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, double t);

}  // namespace canopeer
