#include "canopeer/robot/collision/convex_gap.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

/// How far the shape reaches from its centre in a direction, shape frame.
double reach_of(const CollisionShape& shape, const Vec3& direction) {
  switch (shape.kind) {
    case ShapeKind::kBox:
      return direction.cwiseAbs().dot(shape.size_m) / 2.0;
    case ShapeKind::kCylinder:
      return shape.size_m.x() * direction.head<2>().norm() +
             std::abs(direction.z()) * shape.size_m.z() / 2.0;
    case ShapeKind::kSphere:
      return shape.size_m.x();
    case ShapeKind::kMesh:
      break;
  }
  double farthest = -1e300;
  for (const Vec3& corner : shape.mesh->corners)
    farthest = std::max(farthest, direction.dot(corner));
  return farthest;
}

/// The widest gap in the directions of a's faces. `centre`: of b, and `R`: its axes, in a.
double gap_from_faces(const CollisionShape& a, const CollisionShape& b, const Vec3& centre,
                      const Eigen::Matrix3d& R) {
  double widest = -1e300;
  const auto look = [&](const Vec3& outwards, double reach) {
    const double gap =
        outwards.dot(centre) - reach - reach_of(b, Vec3(-(R.transpose() * outwards)));
    widest = std::max(widest, gap);
  };
  if (a.kind == ShapeKind::kMesh) {
    for (const auto& plane : a.mesh->planes) look(plane.normal, plane.offset_m);
  } else {
    for (int axis = a.kind == ShapeKind::kBox ? 0 : 2; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0})
        look(sign * Vec3::Unit(axis), reach_of(a, Vec3::Unit(axis)));
    }
    const double across = centre.head<2>().norm();
    if (a.kind == ShapeKind::kCylinder && across > 0.0)
      look(Vec3(centre.x() / across, centre.y() / across, 0.0), a.size_m.x());
  }
  if (centre.squaredNorm() > 0.0) look(centre.normalized(), reach_of(a, centre.normalized()));
  return widest;
}

}  // namespace

double convex_gap(const CollisionShape& a, const CollisionShape& b, const Pose& T_a_b) {
  const Pose T_b_a = T_a_b.inverse();
  return std::max(gap_from_faces(a, b, T_a_b.translation(), T_a_b.linear()),
                  gap_from_faces(b, a, T_b_a.translation(), T_b_a.linear()));
}

}  // namespace canopeer
