#include "canopeer/eval/surface_score.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

using Point = Eigen::Vector3f;

constexpr double kSpacing = 0.004;  // of points on the true surfaces, m

/// Barycentric grid on a triangle, corners included.
template <typename Visit>
void sample(const Point& a, const Point& b, const Point& c, double spacing_m, const Visit& visit) {
  const float longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing_m)));
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k <= n - i; ++k) {
      const float u = static_cast<float>(i) / static_cast<float>(n);
      const float v = static_cast<float>(k) / static_cast<float>(n);
      visit(a + u * (b - a) + v * (c - a));
    }
  }
}

/// The body of a fruit, copies too.
struct Body {
  const TriangleMesh& mesh;
  const Pose& T_world_mesh;
  bool counted = false;

  template <typename Visit>
  void for_each_point(double spacing_m, const Visit& visit) const {
    const Eigen::Isometry3f placed = T_world_mesh.cast<float>();
    for (const auto& t : mesh.triangles) {
      const auto& v = mesh.vertices;
      sample(placed * v[t[0]], placed * v[t[1]], placed * v[t[2]], spacing_m, visit);
    }
  }
};

template <typename Visit>
void for_each_body(const Scene& scene, const Visit& visit) {
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
    if (part.kind != PartClass::fruit || part.fruit < 0) return;
    const int fruit = part.fruit + (copy == nullptr ? 0 : copy->first_fruit);
    visit(Body{part.mesh, T, scene.fruits[static_cast<std::size_t>(fruit)].counted});
  });
}

/// Points by cells of a grid, for neighbours within one cell's side.
class PointGrid {
 public:
  PointGrid(std::span<const Point> points, double cell_m) : cell_m_(cell_m) {
    cells_.reserve(points.size());
    for (const Point& p : points) {
      cells_.emplace_back(key(cell_of(p)), p);
      reach_.extend(p.cast<double>());
    }
    if (reach_.isEmpty()) return;
    constexpr double kRounding = 1e-4;
    reach_.min().array() -= cell_m + kRounding;
    reach_.max().array() += cell_m + kRounding;
    std::sort(cells_.begin(), cells_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  /// Whether any of the points can be near one in the box.
  [[nodiscard]] bool reaches(const Box& box) const { return reach_.intersects(box); }

  [[nodiscard]] bool any_near(const Point& p) const {
    if (!reach_.contains(p.cast<double>())) return false;
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
  Box reach_;  // around all points, widened by the distance
};

}  // namespace

std::vector<Point> fruit_surface_points(const Scene& scene, bool counted_only, double spacing_m) {
  std::vector<Point> points;
  for_each_body(scene, [&](const Body& body) {
    if (counted_only && !body.counted) return;
    body.for_each_point(spacing_m, [&](const Point& p) { points.push_back(p); });
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
  // Fruit by fruit: the surfaces of a long row would take a gigabyte together.
  const PointGrid grid(reconstructed, distance_m);
  std::vector<char> near_true(reconstructed.size(), 0);
  std::int64_t counted = 0;
  std::int64_t found = 0;
  std::vector<Point> surface;
  for_each_body(scene, [&](const Body& body) {
    const bool in_reach = grid.reaches(transformed(body.mesh.bounds(), body.T_world_mesh));
    if (!in_reach && !body.counted) return;
    surface.clear();
    body.for_each_point(kSpacing, [&](const Point& p) { surface.push_back(p); });
    if (body.counted) counted += static_cast<std::int64_t>(surface.size());
    if (!in_reach) return;
    if (body.counted) {
      found += std::count_if(surface.begin(), surface.end(),
                             [&](const Point& p) { return grid.any_near(p); });
    }
    const PointGrid body_grid(surface, distance_m);
    for (std::size_t i = 0; i < reconstructed.size(); ++i) {
      if (near_true[i] == 0 && body_grid.any_near(reconstructed[i])) near_true[i] = 1;
    }
  });
  if (counted == 0) return std::nullopt;
  SurfaceScore score;
  if (!reconstructed.empty()) {
    score.precision = static_cast<double>(std::count(near_true.begin(), near_true.end(), char{1})) /
                      static_cast<double>(reconstructed.size());
  }
  score.recall = static_cast<double>(found) / static_cast<double>(counted);
  const double sum = score.precision + score.recall;
  if (sum > 0.0) score.f1 = 2.0 * score.precision * score.recall / sum;
  return score;
}

}  // namespace canopeer
