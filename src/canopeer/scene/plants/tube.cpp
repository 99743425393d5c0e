#include "canopeer/scene/plants/tube.h"

#include <cmath>
#include <numbers>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

Vec3 direction_at(const std::vector<AxisPoint>& axis, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, axis.size() - 1);
  return (axis[after].position - axis[before].position).normalized();
}

}  // namespace

TriangleMesh make_tube(const std::vector<AxisPoint>& axis, int sides) {
  CANOPEER_CHECK(axis.size() >= 2 && sides >= 3, "a tube needs two points and three sides");
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  Vec3 across = direction_at(axis, 0).unitOrthogonal();
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const Vec3 along = direction_at(axis, i);
    across = (across - across.dot(along) * along).normalized();
    const Vec3 other = along.cross(across);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      const Vec3 out = std::cos(angle) * across + std::sin(angle) * other;
      mesh.vertices.emplace_back((axis[i].position + axis[i].radius_m * out).cast<float>());
    }
  }
  const auto rings = static_cast<std::uint32_t>(axis.size());
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = i * n + k;
      const std::uint32_t b = i * n + (k + 1) % n;
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
  }
  for (std::uint32_t k = 1; k + 1 < n; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    const std::uint32_t last = (rings - 1) * n;
    mesh.triangles.push_back({last, last + k, last + k + 1});
  }
  compute_normals(mesh);
  return mesh;
}

Vec3 bezier(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, double t) {
  const double s = 1.0 - t;
  return s * s * s * p0 + 3.0 * s * s * t * p1 + 3.0 * s * t * t * p2 + t * t * t * p3;
}

}  // namespace canopeer
