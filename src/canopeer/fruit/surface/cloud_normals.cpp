#include "canopeer/fruit/surface/cloud_normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "canopeer/fruit/surface/voxel_key.h"

namespace canopeer {
namespace {

/// Points by cells of a grid as wide as the reach.
class PointGrid {
 public:
  PointGrid(std::span<const Vec3> points, double reach_m) : points_(points), reach_m_(reach_m) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      cells_[voxel_key(voxel_at(points[i], reach_m))].push_back(static_cast<int>(i));
    }
  }
  template <typename Visit>
  void near(const Vec3& p, Visit&& visit) const {
    const VoxelIndex cell = voxel_at(p, reach_m_);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells_.find(voxel_key(cell + VoxelIndex(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
      if (found == cells_.end()) continue;
      for (const int i : found->second) {
        if ((points_[static_cast<std::size_t>(i)] - p).squaredNorm() <= reach_m_ * reach_m_)
          visit(i);
      }
    }
  }

 private:
  std::span<const Vec3> points_;
  double reach_m_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;  // never iterated
};

}  // namespace

std::vector<Vec3> estimate_normals(std::span<const Vec3> points, double radius_m,
                                   const std::optional<Vec3>& viewpoint) {
  const PointGrid grid(points, radius_m);
  std::vector<Vec3> normals;
  normals.reserve(points.size());
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  for (const Vec3& p : points) {
    Vec3 sum = Vec3::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int count = 0;
    grid.near(p, [&](int i) {
      const Vec3 d = points[static_cast<std::size_t>(i)] - p;
      sum += d;
      squares += d * d.transpose();
      ++count;
    });
    if (count < 6) {
      normals.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
      continue;
    }
    const Vec3 mean = sum / count;
    axes.computeDirect(squares / count - mean * mean.transpose());
    Vec3 n = axes.eigenvectors().col(0).normalized();
    const Vec3 outward = viewpoint ? Vec3(*viewpoint - p) : Vec3(-mean);
    if (n.dot(outward) < 0.0) n = -n;
    normals.push_back(n);
  }
  return normals;
}

double median_spacing(std::span<const Vec3> points) {
  if (points.size() < 2) return 0.0;
  // Of 400 points against all: the order of points in files means nothing, so every n-th will do.
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 400);
  std::vector<double> nearest;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) least = std::min(least, (points[j] - points[i]).squaredNorm());
    }
    nearest.push_back(std::sqrt(least));
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

std::vector<Vec3> thin_to_grid(std::span<const Vec3> points, double cell_m,
                               std::vector<int>& place) {
  std::unordered_map<std::uint64_t, int> number_of;  // never iterated
  std::vector<Vec3> sums;
  std::vector<int> counts;
  place.clear();
  for (const Vec3& p : points) {
    const auto [entry, is_new] =
        number_of.try_emplace(voxel_key(voxel_at(p, cell_m)), static_cast<int>(sums.size()));
    if (is_new) {
      sums.emplace_back(Vec3::Zero());
      counts.push_back(0);
    }
    sums[static_cast<std::size_t>(entry->second)] += p;
    ++counts[static_cast<std::size_t>(entry->second)];
    place.push_back(entry->second);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
  return sums;
}

}  // namespace canopeer
