#include "canopeer/eval/surface_score.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

using Point = Eigen::Vector3f;

/// Barycentric grid on a triangle, corners included.
void sample(const Point& a, const Point& b, const Point& c, double spacing_m,
            std::vector<Point>& out) {
  const float longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing_m)));
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k <= n - i; ++k) {
      const float u = static_cast<float>(i) / static_cast<float>(n);
      const float v = static_cast<float>(k) / static_cast<float>(n);
      out.push_back(a + u * (b - a) + v * (c - a));
    }
  }
}

/// Points by cells of a grid, for neighbours within one cell's side.
class PointGrid {
 public:
  PointGrid(std::span<const Point> points, double cell_m) : cell_m_(cell_m) {
    for (const Point& p : points) cells_.emplace_back(key(cell_of(p)), p);
    std::sort(cells_.begin(), cells_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  [[nodiscard]] bool any_near(const Point& p) const {
    const VoxelIndex centre = cell_of(p);
    for (int i = 0; i < 27; ++i) {
      const VoxelIndex offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const std::uint64_t wanted = key(centre + offset);
      auto at =
          std::lower_bound(cells_.begin(), cells_.end(), wanted,
                           [](const auto& entry, std::uint64_t k) { return entry.first < k; });
      for (; at != cells_.end() && at->first == wanted; ++at) {
        if ((at->second - p).cast<double>().norm() <= cell_m_) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] VoxelIndex cell_of(const Point& p) const {
    return voxel_at(p.cast<double>(), cell_m_);
  }
  static std::uint64_t key(const VoxelIndex& cell) {
    constexpr std::int64_t kOffset = 1 << 20;
    std::uint64_t k = 0;
    for (int axis = 0; axis < 3; ++axis) {
      k = k << 21U | static_cast<std::uint64_t>((cell[axis] + kOffset) & 0x1FFFFF);
    }
    return k;
  }

  double cell_m_;
  std::vector<std::pair<std::uint64_t, Point>> cells_;
};

}  // namespace

std::vector<Point> fruit_surface_points(const Scene& scene, bool counted_only, double spacing_m) {
  std::vector<Point> points;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
    if (part.kind != PartClass::fruit || part.fruit < 0) return;
    const int fruit = part.fruit + (copy == nullptr ? 0 : copy->first_fruit);
    if (counted_only && !scene.fruits[static_cast<std::size_t>(fruit)].counted) return;
    const Eigen::Isometry3f placed = T.cast<float>();
    for (const auto& t : part.mesh.triangles) {
      const auto& v = part.mesh.vertices;
      sample(placed * v[t[0]], placed * v[t[1]], placed * v[t[2]], spacing_m, points);
    }
  });
  return points;
}

std::optional<double> share_near(std::span<const Point> points, std::span<const Point> others,
                                 double distance_m) {
  if (points.empty()) return std::nullopt;
  const PointGrid grid(others, distance_m);
  const auto near =
      std::count_if(points.begin(), points.end(), [&](const Point& p) { return grid.any_near(p); });
  return static_cast<double>(near) / static_cast<double>(points.size());
}

std::optional<SurfaceScore> surface_score(const Scene& scene, std::span<const Point> reconstructed,
                                          double distance_m) {
  const auto counted = fruit_surface_points(scene, true);
  if (counted.empty()) return std::nullopt;
  SurfaceScore score;
  score.precision =
      share_near(reconstructed, fruit_surface_points(scene, false), distance_m).value_or(0.0);
  score.recall = share_near(counted, reconstructed, distance_m).value_or(0.0);
  const double sum = score.precision + score.recall;
  if (sum > 0.0) score.f1 = 2.0 * score.precision * score.recall / sum;
  return score;
}

}  // namespace canopeer
