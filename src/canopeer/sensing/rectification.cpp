#include "canopeer/sensing/rectification.h"

#include <cmath>

namespace canopeer {

Rectification::Rectification(const CameraIntrinsics& k, const LensDistortion& lens)
    : Rectification(k, k, [&](const Eigen::Vector2d& ideal) { return lens.distort(ideal); }) {}

Rectification::Rectification(const CameraIntrinsics& flat, const CameraIntrinsics& raw,
                             const Lens& lens)
    : width_(flat.width), height_(flat.height) {
  source_.reserve(static_cast<std::size_t>(flat.width) * static_cast<std::size_t>(flat.height));
  for (int v = 0; v < flat.height; ++v) {
    for (int u = 0; u < flat.width; ++u) {
      const Eigen::Vector2d seen = lens(flat.ray(u, v).head<2>());
      const double column = std::floor(seen.x() * raw.fx + raw.cx);
      const double row = std::floor(seen.y() * raw.fy + raw.cy);
      const bool inside = column >= 0.0 && column < raw.width && row >= 0.0 && row < raw.height;
      source_.push_back(inside ? static_cast<int>(row) * raw.width + static_cast<int>(column) : -1);
    }
  }
}

}  // namespace canopeer
