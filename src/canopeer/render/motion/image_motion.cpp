#include "canopeer/render/motion/image_motion.h"

#include <algorithm>
#include <limits>

namespace canopeer {

double image_motion(const DepthImage& depth, const CameraRays& rays, const Pose& T_world_before,
                    const Pose& T_world_camera, const Pose& T_world_after) {
  constexpr int kGrid = 16;  // px between those that are looked at
  constexpr double kFar = 1e3;
  constexpr double kNear = 0.01;
  const CameraIntrinsics& k = rays.intrinsics();
  const Pose T_before = T_world_before.inverse() * T_world_camera;
  const Pose T_after = T_world_after.inverse() * T_world_camera;
  double farthest = 0.0;
  for (int v = kGrid / 2; v < depth.height(); v += kGrid) {
    for (int u = kGrid / 2; u < depth.width(); u += kGrid) {
      const double z = static_cast<double>(depth.at(u, v));
      const Vec3 ray = rays.ray(u, v);
      const Vec3 p = (z > 0.0 ? z : kFar) * ray;
      double moved = 0.0;
      for (const Pose* T : {&T_before, &T_after}) {
        const Vec3 q = *T * p;
        if (q.z() < kNear) return std::numeric_limits<double>::infinity();
        const Vec3 step = q / q.z() - ray;
        moved += Eigen::Vector2d(k.fx * step.x(), k.fy * step.y()).norm();
      }
      farthest = std::max(farthest, moved);
    }
  }
  return farthest;
}

}  // namespace canopeer
