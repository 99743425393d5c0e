#include "canopeer/sensing/rectification.h"

#include <cmath>

namespace canopeer {

Rectification::Rectification(const CameraIntrinsics& k, const LensDistortion& lens) {
  source_.reserve(static_cast<std::size_t>(k.width) * static_cast<std::size_t>(k.height));
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      const Eigen::Vector2d seen = lens.distort(k.ray(u, v).head<2>());
      const double column = std::floor(seen.x() * k.fx + k.cx);
      const double row = std::floor(seen.y() * k.fy + k.cy);
      const bool inside = column >= 0.0 && column < k.width && row >= 0.0 && row < k.height;
      source_.push_back(inside ? static_cast<int>(row) * k.width + static_cast<int>(column) : -1);
    }
  }
}

}  // namespace canopeer
