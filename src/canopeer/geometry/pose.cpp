#include "canopeer/geometry/pose.h"

#include <cmath>

namespace canopeer {

Pose look_at(const Vec3& position, const Vec3& target, double roll_rad) {
  const Vec3 forward = (target - position).normalized();
  const Vec3 up = std::abs(forward.z()) > 1.0 - 1e-9 ? Vec3::UnitX() : Vec3::UnitZ();
  const Vec3 right = forward.cross(up).normalized();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  pose.translation() = position;
  pose.rotate(Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()));
  return pose;
}

Box transformed(const Box& box_b, const Pose& T_a_b) {
  Box box_a;
  for (int i = 0; i < 8; ++i) box_a.extend(T_a_b * box_b.corner(static_cast<Box::CornerType>(i)));
  return box_a;
}

}  // namespace canopeer
