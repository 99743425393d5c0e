#pragma once

#include <ignition/math/Pose3.hh>

#include "canopeer/geometry/pose.h"

namespace canopeer {

inline Vec3 to_vec3(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

inline Pose to_pose(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  Pose T = Pose::Identity();
  T.translation() = to_vec3(pose.Pos());
  T.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  return T;
}

}  // namespace canopeer
