#include "canopeer/import/sdf/extrusion.h"

#include <algorithm>
#include <numeric>

#include "canopeer/scene/flat_faces.h"

namespace canopeer {
namespace {

using Point = Eigen::Vector2d;
using Triangle = std::array<std::uint32_t, 3>;

/// Twice the area of a, b, c; positive when they turn left.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double twice_area(const std::vector<Point>& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& next = outline[(i + 1) % outline.size()];
    sum += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return sum;
}

/// Whether the corner `at` of the outline that is left can be cut off: it turns left, and no other
/// corner lies in the cut.
bool is_ear(const std::vector<Point>& points, const std::vector<std::uint32_t>& left,
            std::size_t at) {
  const std::size_t n = left.size();
  const Point& a = points[left[(at + n - 1) % n]];
  const Point& b = points[left[at]];
  const Point& c = points[left[(at + 1) % n]];
  if (turn(a, b, c) <= 0.0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::uint32_t i) {
    const Point& p = points[i];
    if (p == a || p == b || p == c) return false;
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
  });
}

/// Triangles over an outline that turns left, by cutting off ears; nothing when there is none left
/// to cut, which only an outline that crosses itself does.
std::optional<std::vector<Triangle>> cut_ears(const std::vector<Point>& points) {
  std::vector<std::uint32_t> left(points.size());
  std::iota(left.begin(), left.end(), 0U);
  std::vector<Triangle> triangles;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t at = 0;
    while (at < n && !is_ear(points, left, at)) ++at;
    if (at == n) return std::nullopt;
    triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

/// Without corners that are given twice or lie on a straight line.
std::vector<Point> essential(std::vector<Point> outline) {
  for (bool changed = true; changed && outline.size() >= 3;) {
    changed = false;
    for (std::size_t i = 0; i < outline.size() && outline.size() >= 3; ++i) {
      const std::size_t n = outline.size();
      const Point& a = outline[(i + n - 1) % n];
      const Point& c = outline[(i + 1) % n];
      if (outline[i] != a && turn(a, outline[i], c) != 0.0) continue;
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
    }
  }
  return outline;
}

}  // namespace

std::optional<TriangleMesh> extruded_mesh(std::vector<Point> outline, double height_m) {
  for (const Point& p : outline) {
    if (!p.allFinite()) return std::nullopt;
  }
  outline = essential(std::move(outline));
  if (outline.size() < 3 || !(height_m > 0.0)) return std::nullopt;
  if (twice_area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  const auto lid = cut_ears(outline);
  if (!lid) return std::nullopt;
  TriangleMesh mesh;
  for (const double z : {0.0, height_m}) {
    for (const Point& p : outline) mesh.vertices.push_back(Vec3(p.x(), p.y(), z).cast<float>());
  }
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const Triangle& t : *lid) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, next + n});
    mesh.triangles.push_back({i, next + n, i + n});
  }
  return with_flat_faces(mesh);
}

}  // namespace canopeer
