#include "canopeer/sensing/alignment/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace canopeer {
namespace {

constexpr float kMostStep = 0.06F;    // neighbours in one surface, of the depth
constexpr float kMostBend = 0.012F;   // root mean square off the plane, of the depth
constexpr float kLeastCosine = 0.3F;  // of the angle of incidence

/// The plane through the window about a pixel.
std::optional<SurfacePatch> fit_patch(const CameraIntrinsics& k, const DepthImage& depth, int u,
                                      int v, int radius) {
  const float middle = depth.at(u, v);
  if (!(middle > 0.0F && std::isfinite(middle))) return std::nullopt;
  float sum = 0, sum_u = 0, sum_v = 0, squares = 0, offsets = 0;
  int count = 0;
  for (int dv = -radius; dv <= radius; ++dv) {
    for (int du = -radius; du <= radius; ++du) {
      const float d = depth.at(u + du, v + dv);
      if (!(std::abs(d - middle) < kMostStep * middle)) return std::nullopt;
      const float inverse = 1.0F / d;
      sum += inverse;
      sum_u += static_cast<float>(du) * inverse;
      sum_v += static_cast<float>(dv) * inverse;
      squares += inverse * inverse;
      offsets += static_cast<float>(du * du);
      ++count;
    }
  }
  const float n = static_cast<float>(count);
  const float c = sum / n, a = sum_u / offsets, b = sum_v / offsets;
  const float left = squares / n - c * c - (a * a + b * b) * offsets / n;
  if (left > kMostBend * kMostBend * c * c) return std::nullopt;
  // 1/z = a (u − u₀) + b (v − v₀) + c, which is normal · point = 1.
  const Eigen::Vector3f ray = k.ray(u, v).cast<float>();
  Eigen::Vector3f normal(a * static_cast<float>(k.fx), b * static_cast<float>(k.fy), 0.0F);
  normal.z() = c - normal.x() * ray.x() - normal.y() * ray.y();
  const float length = normal.norm();
  if (c < kLeastCosine * length * ray.norm()) return std::nullopt;
  return SurfacePatch{ray / c, normal / length};
}

}  // namespace

SurfacePatches::SurfacePatches(const CameraIntrinsics& k, const DepthImage& depth, int step) {
  across_ = k.width / step;
  down_ = k.height / step;
  const auto s = static_cast<float>(step);
  fx_ = static_cast<float>(k.fx) / s;
  fy_ = static_cast<float>(k.fy) / s;
  cx_ = static_cast<float>(k.cx) / s;
  cy_ = static_cast<float>(k.cy) / s;
  index_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_), -1);
  const int radius = std::max(2, static_cast<int>(std::lround(k.fx / 120.0)));
  for (int row = 0; row < down_; ++row) {
    const int v = row * step + step / 2;
    if (v < radius || v + radius >= k.height) continue;
    for (int column = 0; column < across_; ++column) {
      const int u = column * step + step / 2;
      if (u < radius || u + radius >= k.width) continue;
      const auto patch = fit_patch(k, depth, u, v, radius);
      if (!patch) continue;
      index_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
             static_cast<std::size_t>(column)] = static_cast<int>(patches_.size());
      patches_.push_back(*patch);
    }
  }
}

}  // namespace canopeer
