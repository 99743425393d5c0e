#pragma once

#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// How exactly axes of a description must be parallel, at right angles or meet: metres or unit
/// vectors.
inline constexpr double kAxisTolerance = 1e-7;

inline bool parallel(const Vec3& a, const Vec3& b) { return a.cross(b).norm() < kAxisTolerance; }
inline bool perpendicular(const Vec3& a, const Vec3& b) {
  return std::abs(a.dot(b)) < kAxisTolerance;
}

/// Point where two axes at right angles meet; `gap` receives how far they miss each other.
inline Vec3 meeting_point(const RobotModel::AxisLine& a, const RobotModel::AxisLine& b,
                          double& gap) {
  const Vec3 between = b.point - a.point;
  gap = std::abs(between.dot(a.direction.cross(b.direction)));
  return a.point + a.direction * between.dot(a.direction);
}

/// Angle from u to v about `axis`, all unit vectors, u and v perpendicular to it.
inline double angle_about(const Vec3& axis, const Vec3& u, const Vec3& v) {
  return std::atan2(axis.dot(u.cross(v)), u.dot(v));
}

/// Frame at `origin` with the given axes, in the frame they are given in.
inline Pose frame_of(const Vec3& origin, const Vec3& x, const Vec3& z) {
  Pose T = Pose::Identity();
  T.linear() << x, z.cross(x), z;
  T.translation() = origin;
  return T;
}

}  // namespace canopeer
