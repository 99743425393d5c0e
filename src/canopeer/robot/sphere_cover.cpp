#include "canopeer/robot/sphere_cover.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

std::vector<Sphere> cover_cylinder(double radius, double length, double max_excess) {
  // A sphere of radius R around an axis point holds the stretch of ±√(R² − r²) of the cylinder.
  const double stretch = std::sqrt((radius + max_excess) * (radius + max_excess) - radius * radius);
  const int count = std::max(1, static_cast<int>(std::ceil(length / (2.0 * stretch))));
  const double half = length / (2.0 * count);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i)
    spheres.push_back(
        {Vec3(0.0, 0.0, -length / 2.0 + (2 * i + 1) * half), std::hypot(radius, half)});
  return spheres;
}

std::vector<Sphere> cover_box(const Vec3& edges, double max_excess) {
  const double cell_edge = std::max(edges.minCoeff(), 2.0 * max_excess);
  const Eigen::Vector3i count =
      (edges / cell_edge - Vec3::Constant(1e-9)).array().ceil().cast<int>().max(1);
  const Vec3 cell = edges.cwiseQuotient(count.cast<double>());
  std::vector<Sphere> spheres;
  for (int x = 0; x < count.x(); ++x) {
    for (int y = 0; y < count.y(); ++y) {
      for (int z = 0; z < count.z(); ++z) {
        const Vec3 centre = (Vec3(x, y, z).array() + 0.5).matrix().cwiseProduct(cell) - edges / 2.0;
        spheres.push_back({centre, cell.norm() / 2.0});
      }
    }
  }
  return spheres;
}

}  // namespace

std::vector<Sphere> cover_with_spheres(const CollisionShape& shape, double max_excess_m) {
  CANOPEER_CHECK(max_excess_m > 0.0, "spheres need some room");
  std::vector<Sphere> spheres;
  switch (shape.kind) {
    case ShapeKind::kSphere:
      spheres = {{Vec3::Zero(), shape.size_m.x()}};
      break;
    case ShapeKind::kCylinder:
      spheres = cover_cylinder(shape.size_m.x(), shape.size_m.z(), max_excess_m);
      break;
    case ShapeKind::kBox:
      spheres = cover_box(shape.size_m, max_excess_m);
      break;
  }
  for (Sphere& sphere : spheres) sphere.centre = shape.T_link_shape * sphere.centre;
  return spheres;
}

Sphere bounding_sphere(const std::vector<Sphere>& spheres) {
  Box box;
  for (const Sphere& sphere : spheres) {
    box.extend(sphere.centre - Vec3::Constant(sphere.radius_m));
    box.extend(sphere.centre + Vec3::Constant(sphere.radius_m));
  }
  Sphere bound{box.center(), 0.0};
  for (const Sphere& sphere : spheres)
    bound.radius_m =
        std::max(bound.radius_m, (sphere.centre - bound.centre).norm() + sphere.radius_m);
  return bound;
}

double signed_distance(const CollisionShape& shape, const Vec3& p_shape) {
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return p_shape.norm() - shape.size_m.x();
    case ShapeKind::kCylinder: {
      const double radial = p_shape.head<2>().norm() - shape.size_m.x();
      const double axial = std::abs(p_shape.z()) - shape.size_m.z() / 2.0;
      if (radial <= 0.0 || axial <= 0.0) return std::max(radial, axial);
      return std::sqrt(radial * radial + axial * axial);
    }
    case ShapeKind::kBox: {
      const Vec3 beyond = p_shape.cwiseAbs() - shape.size_m / 2.0;
      if (beyond.maxCoeff() <= 0.0) return beyond.maxCoeff();
      return beyond.cwiseMax(0.0).norm();
    }
  }
  return 0.0;
}

}  // namespace canopeer
