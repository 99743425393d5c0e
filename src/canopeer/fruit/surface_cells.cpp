#include "canopeer/fruit/surface_cells.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "canopeer/base/check.h"
#include "canopeer/fruit/voxel_clusters.h"

namespace canopeer {
namespace {

/// Neighbours across an edge: a step in depth makes a pixel a mix of two surfaces on real sensors.
bool at_depth_edge(const DepthImage& depth, int u, int v, float max_step) {
  const float z = depth.at(u, v);
  constexpr int kNeighbours[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  return std::any_of(std::begin(kNeighbours), std::end(kNeighbours), [&](const int(&d)[2]) {
    const float neighbour = depth.at(u + d[0], v + d[1]);
    return neighbour > 0.0F && std::abs(neighbour - z) > max_step;
  });
}

/// Outward normal in the camera frame by a plane through the fruit pixels around: a plane is linear
/// in inverse depth, 1/z = n · (x, y, 1). None at the mask's rims, where too few pixels support it.
std::optional<Vec3> normal_at(const RgbdFrame& frame, const Mask& fruit, int u0, int v0,
                              const FruitMapOptions& options) {
  const CameraIntrinsics& k = frame.intrinsics;
  const double z0 = frame.depth.at(u0, v0);
  int half = std::clamp(static_cast<int>(std::lround(options.normal_window_m * k.fx / z0)), 1, 4);
  const int step = half > 2 ? 2 : 1;  // of a large window every other pixel is enough
  half -= half % step;
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  int used = 0;
  for (int v = v0 - half; v <= v0 + half; v += step) {
    for (int u = u0 - half; u <= u0 + half; u += step) {
      if (u < 0 || v < 0 || u >= k.width || v >= k.height || fruit.at(u, v) == 0) continue;
      const double z = frame.depth.at(u, v);
      if (!(z > 0.0) || std::abs(z - z0) > options.max_depth_step_m) continue;
      const Vec3 x((u - u0) / k.fx, (v - v0) / k.fy, 1.0);
      a.noalias() += x * x.transpose();
      b += x / z;
      ++used;
    }
  }
  const int side = 2 * half / step + 1;
  if (used < std::max(5, side * side / 2)) return std::nullopt;
  const Vec3 local = a.inverse() * b;  // about the pixel's own ray
  const Vec3 ray0 = k.ray(u0, v0);
  Vec3 n(local.x(), local.y(), local.z() - local.x() * ray0.x() - local.y() * ray0.y());
  if (!n.allFinite() || n.norm() < 1e-9) return std::nullopt;
  n = -n.normalized();
  if (-n.dot(ray0.normalized()) < options.min_cos_incidence) return std::nullopt;
  return n;
}

}  // namespace

Rgb SurfaceCell::color() const {
  const auto mean = [&](int channel) {
    return static_cast<std::uint8_t>((color_sum[channel] + hits / 2) / hits);
  };
  return {mean(0), mean(1), mean(2)};
}

SurfaceCells::SurfaceCells(const FruitMapOptions& options) : options_(options) {}

std::vector<int> SurfaceCells::add(const RgbdFrame& frame, const Mask& fruit) {
  const CameraIntrinsics& k = frame.intrinsics;
  CANOPEER_CHECK(fruit.width() == k.width && fruit.height() == k.height, "mask of this frame");
  CANOPEER_CHECK(frame.depth.width() == k.width && frame.depth.height() == k.height,
                 "depth as the intrinsics say");
  const bool colored = frame.color.width() == k.width && frame.color.height() == k.height;
  std::vector<int> changed;
  for (int v = 1; v + 1 < k.height; ++v) {
    for (int u = 1; u + 1 < k.width; ++u) {
      if (fruit.at(u, v) == 0) continue;
      const float z = frame.depth.at(u, v);
      if (!(z > 0.0F) || z > options_.max_range_m) continue;
      if (at_depth_edge(frame.depth, u, v, static_cast<float>(options_.max_depth_step_m))) continue;
      const std::optional<Vec3> normal = normal_at(frame, fruit, u, v, options_);
      if (!normal) continue;
      const Vec3 p_world = frame.T_world_camera * (double{z} * k.ray(u, v));
      const int cell = cell_at(p_world);
      SurfaceCell& sums = cells_[cell];
      sums.point_sum += p_world;
      sums.normal_sum += frame.T_world_camera.linear() * *normal;
      if (colored) {
        const Rgb& c = frame.color.at(u, v);
        sums.color_sum[0] += c.r;
        sums.color_sum[1] += c.g;
        sums.color_sum[2] += c.b;
      }
      ++sums.hits;
      changed.push_back(cell);
    }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  std::erase_if(changed, [this](int cell) { return !counts(cell); });
  return changed;
}

int SurfaceCells::cell_at(const Vec3& p_world) {
  const VoxelIndex index = voxel_at(p_world, options_.cell_m);
  const auto [entry, is_new] =
      number_of_.try_emplace(voxel_key(index), static_cast<int>(cells_.size()));
  if (is_new) cells_.emplace_back().index = index;
  return entry->second;
}

}  // namespace canopeer
