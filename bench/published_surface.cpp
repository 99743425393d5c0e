#include "published_surface.h"

#include <algorithm>
#include <cmath>

#include "canopeer/fruit/instances/euclidean_clusters.h"
#include "canopeer/fruit/surface/voxel_key.h"

namespace canopeer {

std::vector<double> neighbour_distances(const Image<Vec3>& points, const Mask& there,
                                        const std::vector<int>& pixels, int neighbours) {
  constexpr int kReach = 4;
  std::vector<double> means;
  std::vector<double> near;
  for (const int pixel : pixels) {
    const int u = pixel % points.width();
    const int v = pixel / points.width();
    near.clear();
    for (int dv = -kReach; dv <= kReach; ++dv) {
      for (int du = -kReach; du <= kReach; ++du) {
        const int x = u + du;
        const int y = v + dv;
        if ((du == 0 && dv == 0) || x < 0 || y < 0 || x >= points.width() || y >= points.height()) {
          continue;
        }
        if (there.at(x, y) != 0) near.push_back((points.at(x, y) - points.at(u, v)).norm());
      }
    }
    const auto count = std::min(near.size(), static_cast<std::size_t>(neighbours));
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += near[i];
    means.push_back(count == 0 ? INFINITY : sum / static_cast<double>(count));
  }
  return means;
}

double outlier_limit(const std::vector<double>& means, double deviations) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const double d : means) {
    if (!std::isfinite(d)) continue;
    n += 1.0;
    sum += d;
    squares += d * d;
  }
  if (n < 2.0) return INFINITY;
  const double variance = std::max(0.0, (squares - sum * sum / n) / (n - 1.0));
  return sum / n + deviations * std::sqrt(variance);
}

std::vector<PublishedSurface::Seen> PublishedSurface::points_of(const RgbdFrame& frame,
                                                                const Mask& fruit) const {
  const CameraIntrinsics& camera = frame.intrinsics;
  const int width = frame.depth.width();
  Image<Vec3> points(width, frame.depth.height(), Vec3::Zero());
  Mask there(width, frame.depth.height(), 0);
  std::vector<int> pixels;
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < width; ++u) {
      const double z = frame.depth.at(u, v);
      if (fruit.at(u, v) == 0 || !(z > 0.0) || !std::isfinite(z)) continue;
      points.at(u, v) = z * camera.ray(u, v);
      there.at(u, v) = 1;
      pixels.push_back(v * width + u);
    }
  }
  std::vector<double> means(pixels.size(), 0.0);
  if (options_.drop_outliers) {
    means = neighbour_distances(points, there, pixels, options_.neighbours);
  }
  const double limit = outlier_limit(means, options_.deviations);
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (options_.drop_outliers && !(means[i] <= limit)) continue;
    const Vec3& p = points.at(pixels[i] % width, pixels[i] / width);
    seen.push_back({frame.T_world_camera * p, p.z()});
  }
  return seen;
}

void PublishedSurface::add(const RgbdFrame& frame, const Mask& fruit) {
  for (const Seen& seen : points_of(frame, fruit)) cast(frame.T_world_camera.translation(), seen);
}

/// One ray, from the camera to the truncation distance behind the point. Voxels in front of the
/// band around the surface are only carved where they are known.
void PublishedSurface::cast(const Vec3& origin, const Seen& seen) {
  const double truncation = options_.truncation_voxels * options_.voxel_m;
  const Vec3 ray = (seen.point - origin).normalized();
  const double range = (seen.point - origin).norm();
  walk_voxels(origin, seen.point + truncation * ray, options_.voxel_m, [&](const VoxelIndex& at) {
    const double distance = range - (voxel_centre(at, options_.voxel_m) - origin).dot(ray);
    double weight = 1.0 / (seen.depth_m * seen.depth_m);
    if (distance < -options_.voxel_m) {  // less and less behind the surface
      weight *= std::max(0.0, (truncation + distance) / (truncation - options_.voxel_m));
    }
    if (weight < 1e-6) return true;
    Voxel* voxel = nullptr;
    if (distance > truncation) {
      const auto known = voxels_.find(voxel_key(at));
      if (known == voxels_.end()) return true;
      voxel = &known->second;
    } else {
      voxel = &voxels_[voxel_key(at)];
    }
    const double sum = voxel->weight + weight;
    const double mean = (voxel->distance_m * voxel->weight + distance * weight) / sum;
    voxel->distance_m = static_cast<float>(std::clamp(mean, -truncation, truncation));
    voxel->weight = static_cast<float>(std::min(sum, 1e4));
    return true;
  });
}

std::vector<Vec3> PublishedSurface::fruit_centres() const {
  std::vector<std::uint64_t> keys;
  for (const auto& [key, voxel] : voxels_) {
    if (std::abs(voxel.distance_m) < options_.surface_voxels * options_.voxel_m)
      keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<SurfacePoint> points;
  for (const std::uint64_t key : keys) {
    points.push_back({voxel_centre(voxel_of_key(key), options_.voxel_m), Vec3::UnitZ()});
  }
  const std::vector<int> cluster = euclidean_clusters(points, options_.cluster_tolerance_m);
  std::vector<Vec3> sums;
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto c = static_cast<std::size_t>(cluster[i]);
    if (c >= sums.size()) {
      sums.resize(c + 1, Vec3::Zero());
      sizes.resize(c + 1, 0);
    }
    sums[c] += points[i].point;
    ++sizes[c];
  }
  std::vector<Vec3> centres;
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (sizes[c] >= options_.min_points) centres.push_back(sums[c] / static_cast<double>(sizes[c]));
  }
  return centres;
}

}  // namespace canopeer
