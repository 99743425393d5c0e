#include "canopeer/robot/self_filter.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/robot/sphere_cover.h"

namespace canopeer {
namespace {

struct PixelRange {
  int first = 0;
  int last = -1;
};

// Pixels of one image axis that a ball can be seen at: centre (across, z) on that axis, camera
// frame.
PixelRange pixels_of_ball(double across, double z, double radius, double f, double c, int size) {
  const double nearest = z - radius;
  if (nearest <= 1e-3) return {0, size - 1};
  const auto pixel = [&](double x, bool outward) {
    return f * x / (outward ? nearest : z + radius) + c;
  };
  const double low = across - radius;
  const double high = across + radius;
  const double limit = size;
  const double first = std::clamp(std::floor(pixel(low, low < 0.0)) - 1.0, 0.0, limit);
  const double last = std::clamp(std::ceil(pixel(high, high > 0.0)) + 1.0, -1.0, limit - 1.0);
  return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace

SelfFilter::SelfFilter(const RobotModel& robot, const SelfFilterOptions& options)
    : robot_(&robot), options_(options) {
  CANOPEER_CHECK(options.padding_m >= 0.0, "padding must not be negative");
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    for (const CollisionShape& shape : robot.links()[i].collision) {
      shapes_.push_back({static_cast<int>(i), shape, shape.half_extents().norm()});
    }
  }
}

std::int64_t SelfFilter::mask(RgbdFrame& frame, const Configuration& q,
                              const TrolleyState& trolley) const {
  std::vector<Pose> T_world_link;
  robot_->link_poses(q, trolley, T_world_link);
  const Pose T_camera_world = frame.T_world_camera.inverse();
  std::int64_t masked = 0;
  for (const Shape& shape : shapes_) {
    const Pose& T_world_this = T_world_link[static_cast<std::size_t>(shape.link)];
    masked += mask(frame, shape, T_camera_world * T_world_this * shape.shape.T_link_shape);
  }
  return masked;
}

std::int64_t SelfFilter::mask(RgbdFrame& frame, const Shape& shape,
                              const Pose& T_camera_shape) const {
  const CameraIntrinsics& k = frame.intrinsics;
  const Vec3 centre = T_camera_shape.translation();
  const double radius = shape.radius_m + options_.padding_m;
  if (centre.z() + radius <= 0.0) return 0;
  const PixelRange columns = pixels_of_ball(centre.x(), centre.z(), radius, k.fx, k.cx, k.width);
  const PixelRange rows = pixels_of_ball(centre.y(), centre.z(), radius, k.fy, k.cy, k.height);
  const Pose T_shape_camera = T_camera_shape.inverse();
  std::int64_t masked = 0;
  for (int v = rows.first; v <= rows.last; ++v) {
    for (int u = columns.first; u <= columns.last; ++u) {
      float& pixel = frame.depth.at(u, v);
      const auto depth = static_cast<double>(pixel);
      if (!(depth > 0.0 && std::abs(depth - centre.z()) <= radius)) continue;
      const Vec3 p = depth * k.ray(u, v);
      if ((p - centre).squaredNorm() > radius * radius) continue;
      if (signed_distance(shape.shape, T_shape_camera * p) > options_.padding_m) continue;
      pixel = -1.0F;
      ++masked;
    }
  }
  return masked;
}

}  // namespace canopeer
