#include "canopeer/eval/surface_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

std::uint64_t key_of(const VoxelIndex& cell) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
  return part(cell.x()) << 42U | part(cell.y()) << 21U | part(cell.z());
}

/// Points by the cells of a grid as wide as the reach: a neighbour lies in one of 27.
class SeenPoints {
 public:
  SeenPoints(const PointCloud& seen, double reach_m) : reach_m_(reach_m) {
    for (const auto& p : seen.points) {
      points_[key_of(voxel_at(p.cast<double>(), reach_m))].push_back(p.cast<double>());
    }
  }
  [[nodiscard]] bool any_near(const Vec3& p) const {
    const VoxelIndex cell = voxel_at(p, reach_m_);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          points_.find(key_of(cell + VoxelIndex(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
      if (found == points_.end()) continue;
      const auto near = [&](const Vec3& q) { return (q - p).squaredNorm() <= reach_m_ * reach_m_; };
      if (std::any_of(found->second.begin(), found->second.end(), near)) return true;
    }
    return false;
  }

 private:
  double reach_m_;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> points_;  // never iterated
};

struct Areas {
  double seen = 0.0;
  double all = 0.0;
};

/// The triangle as n² small ones, each judged by its middle.
void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const SeenPoints& seen,
                  double part_m, Areas& areas) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const int n = std::clamp(static_cast<int>(std::ceil(longest / part_m)), 1, 200);
  const double area = 0.5 * (b - a).cross(c - a).norm() / (n * n);
  const auto judge = [&](double u, double v) {
    areas.all += area;
    if (seen.any_near(a + u / n * (b - a) + v / n * (c - a))) areas.seen += area;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      judge(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < n) judge(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
}

}  // namespace

std::vector<double> fruit_coverage(const Scene& scene, const PointCloud& seen, double reach_m) {
  const SeenPoints points(seen, reach_m);
  std::vector<Areas> areas(scene.fruits.size());
  for (const ScenePart& part : scene.parts) {
    if (part.fruit < 0) continue;
    for (const auto& t : part.mesh.triangles) {
      const auto corner = [&](int k) -> Vec3 {
        return part.mesh.vertices[t[static_cast<std::size_t>(k)]].cast<double>();
      };
      add_triangle(corner(0), corner(1), corner(2), points, 2.0 * reach_m,
                   areas[static_cast<std::size_t>(part.fruit)]);
    }
  }
  std::vector<double> shares;
  shares.reserve(areas.size());
  for (const Areas& a : areas) shares.push_back(a.all > 0.0 ? a.seen / a.all : 0.0);
  return shares;
}

}  // namespace canopeer
