#include "canopeer/import/shape_mesh.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "canopeer/scene/flat_faces.h"

namespace canopeer {
namespace {

constexpr int kSides = 32;

/// A circle of the outline of a body of revolution about z.
struct Ring {
  double radius;
  double z;
};

/// Rings from bottom to top, joined by quads; rings of radius 0 are points.
TriangleMesh lathe(const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  for (const Ring& ring : rings) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      mesh.vertices.emplace_back(static_cast<float>(ring.radius * std::cos(angle)),
                                 static_cast<float>(ring.radius * std::sin(angle)),
                                 static_cast<float>(ring.z));
    }
  }
  for (std::uint32_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t a = i * kSides + k;
      const std::uint32_t b = i * kSides + (k + 1) % kSides;
      if (rings[i].radius > 0.0) mesh.triangles.push_back({a, b, b + kSides});
      if (rings[i + 1].radius > 0.0) mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh box_mesh(const Vec3& size_m) {
  return with_flat_faces(make_box(Box(-0.5 * size_m, 0.5 * size_m)));
}

TriangleMesh ellipsoid_mesh(const Vec3& radii_m) {
  std::vector<Ring> rings;
  for (int i = 0; i <= kSides / 2; ++i) {
    const double polar = std::numbers::pi * i / (kSides / 2);
    const bool pole = i == 0 || i == kSides / 2;
    rings.push_back({pole ? 0.0 : std::sin(polar), -std::cos(polar)});
  }
  TriangleMesh mesh = lathe(rings);
  for (auto& v : mesh.vertices) {
    const Eigen::Vector3f n = v.cwiseQuotient(radii_m.cast<float>().cwiseMax(1e-6F));
    mesh.normals.push_back(n.normalized());
    v = v.cwiseProduct(radii_m.cast<float>());
  }
  return mesh;
}

TriangleMesh cylinder_mesh(double radius_m, double length_m) {
  const double h = 0.5 * length_m;
  return with_flat_faces(lathe({{0.0, -h}, {radius_m, -h}, {radius_m, h}, {0.0, h}}));
}

TriangleMesh cone_mesh(double radius_m, double length_m) {
  const double h = 0.5 * length_m;
  return with_flat_faces(lathe({{0.0, -h}, {radius_m, -h}, {0.0, h}}));
}

TriangleMesh capsule_mesh(double radius_m, double length_m) {
  std::vector<Ring> rings;
  constexpr int kSteps = kSides / 4;
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = std::numbers::pi / 2.0 * (half == 0 ? i - kSteps : i) / kSteps;
      const bool pole = half == 0 ? i == 0 : i == kSteps;
      rings.push_back({pole ? 0.0 : radius_m * std::cos(angle),
                       radius_m * std::sin(angle) + (half == 0 ? -0.5 : 0.5) * length_m});
    }
  }
  TriangleMesh mesh = lathe(rings);
  compute_normals(mesh);
  return mesh;
}

TriangleMesh plane_mesh(const Vec3& normal, double width_m, double height_m) {
  // The least turn from z to the normal; any half turn where it points down.
  const Vec3 n = normal.normalized();
  const double twice_w = std::sqrt((1.0 + n.z()) * 2.0);
  const Eigen::Quaterniond turn =
      n.z() < -1.0 + 1e-12
          ? Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0)
          : Eigen::Quaterniond(twice_w / 2.0, -n.y() / twice_w, n.x() / twice_w, 0.0);
  TriangleMesh mesh;
  for (const auto& [x, y] : {std::array{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    mesh.vertices.emplace_back((turn * Vec3(x * width_m, y * height_m, 0.0)).cast<float>());
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  compute_normals(mesh);
  return mesh;
}

}  // namespace canopeer
