#include "canopeer/render/motion/image_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace canopeer {

double image_motion(const DepthImage& depth, const CameraRays& rays, const Pose& T_world_before,
                    const Pose& T_world_camera, const Pose& T_world_after) {
  constexpr int kGrid = 16;  // px between those that are looked at
  constexpr double kFar = 1e3;
  constexpr double kNear = 0.01;
  const CameraIntrinsics& k = rays.intrinsics();
  const Pose T_before = T_world_before.inverse() * T_world_camera;
  const Pose T_after = T_world_after.inverse() * T_world_camera;
  std::vector<double> moved;
  for (int v = kGrid / 2; v < depth.height(); v += kGrid) {
    for (int u = kGrid / 2; u < depth.width(); u += kGrid) {
      const double z = static_cast<double>(depth.at(u, v));
      const Vec3 ray = rays.ray(u, v);
      const Vec3 p = (z > 0.0 ? z : kFar) * ray;
      moved.push_back(0.0);
      for (const Pose* T : {&T_before, &T_after}) {
        const Vec3 q = *T * p;
        const Vec3 step = q / q.z() - ray;
        moved.back() += q.z() < kNear ? std::numeric_limits<double>::infinity()
                                      : std::hypot(k.fx * step.x(), k.fy * step.y());
      }
    }
  }
  if (moved.empty()) return 0.0;
  const auto most = moved.begin() + static_cast<std::ptrdiff_t>(moved.size() * 9 / 10);
  std::nth_element(moved.begin(), most, moved.end());
  return *most;
}

}  // namespace canopeer
