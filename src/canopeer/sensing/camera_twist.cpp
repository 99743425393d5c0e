#include "canopeer/sensing/camera_twist.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

double image_speed(const CameraTwist& twist, const CameraIntrinsics& camera, double distance_m) {
  const Vec3& v = twist.linear;
  const Vec3& w = twist.angular;
  double fastest2 = 0.0;
  for (const double u : {0.0, 0.5, 1.0}) {
    for (const double row : {0.0, 0.5, 1.0}) {
      const double x = (u * camera.width - camera.cx) / camera.fx;
      const double y = (row * camera.height - camera.cy) / camera.fy;
      const double dx =
          (-v.x() + x * v.z()) / distance_m + x * y * w.x() - (1.0 + x * x) * w.y() + y * w.z();
      const double dy =
          (-v.y() + y * v.z()) / distance_m + (1.0 + y * y) * w.x() - x * y * w.y() - x * w.z();
      const double du = camera.fx * dx;
      const double dv = camera.fy * dy;
      fastest2 = std::max(fastest2, du * du + dv * dv);
    }
  }
  return std::sqrt(fastest2);
}

CameraTwist twist_between(const Pose& T_world_before, const Pose& T_world_after, double seconds) {
  CameraTwist twist;
  if (!(seconds > 0.0)) return twist;
  const Pose T = T_world_before.inverse() * T_world_after;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(T.linear()));
  twist.linear = T.translation() / seconds;
  twist.angular = turn.angle() / seconds * turn.axis();
  return twist;
}

}  // namespace canopeer
