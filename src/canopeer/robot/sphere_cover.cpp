#include "canopeer/robot/sphere_cover.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/base/hypotenuse.h"
#include "canopeer/robot/convex_corners.h"

namespace canopeer {
namespace {

/// No shape gets more pieces along an axis, or in all: where it is drawn a thousand times too
/// large, say, they are larger.
constexpr double kMaxPieces = 4096.0;

/// Corners are known to about a nanometre.
constexpr double kRounding = 1e-7;

/// Thick boxes and meshes are cut in pieces no thicker: spheres around larger ones would stick out
/// far, and would be larger than what distance fields know.
constexpr double kThickestBoxM = 0.12;
constexpr double kThickestMeshM = 0.025;

double thickness(const Vec3& edges, double thickest, double max_excess) {
  return std::max(std::min(edges.minCoeff(), thickest), 2.0 * max_excess);
}

std::vector<Sphere> cover_cylinder(double radius, double length, double max_excess) {
  // A sphere of radius R around an axis point holds the stretch of ±√(R² − r²) of the cylinder.
  const double stretch = std::sqrt((radius + max_excess) * (radius + max_excess) - radius * radius);
  const int count =
      static_cast<int>(std::clamp(std::ceil(length / (2.0 * stretch)), 1.0, kMaxPieces));
  const double half = length / (2.0 * count);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i)
    spheres.push_back(
        {Vec3(0.0, 0.0, -length / 2.0 + (2 * i + 1) * half), hypotenuse(radius, half)});
  return spheres;
}

std::vector<Sphere> cover_box(const Vec3& edges, double max_excess) {
  double cell_edge = thickness(edges, kThickestBoxM, max_excess);
  const auto cells = [&] {
    return (edges / cell_edge - Vec3::Constant(1e-9)).array().ceil().max(1.0).eval();
  };
  while (cells().prod() > kMaxPieces) cell_edge *= 1.5;
  const Eigen::Vector3i count = cells().cast<int>();
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

/// A small sphere around points: Bădoiu & Clarkson 2003, steps towards the farthest one.
Sphere sphere_around(const std::vector<Vec3>& points) {
  Box box;
  for (const Vec3& p : points) box.extend(p);
  Vec3 centre = box.center();
  const auto farthest = [&] {
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - centre).squaredNorm() < (b - centre).squaredNorm();
    });
  };
  for (int step = 2; step < 40; ++step) centre += (farthest() - centre) / step;
  return {centre, (farthest() - centre).norm()};
}

/// The part of a mesh's solid in a box, by its corners; empty: none.
std::vector<Vec3> corners_within(const CollisionShape& shape, const Vec3& centre,
                                 const Vec3& half) {
  std::vector<ShapeMesh::Plane> planes;
  for (const auto& plane : shape.mesh->planes) {
    const double reach = plane.normal.cwiseAbs().dot(half);
    const double spare = plane.offset_m - plane.normal.dot(centre);
    if (spare < -reach - 1e-9) return {};
    if (spare < reach) planes.push_back(plane);  // it cuts through the box
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 normal = sign * Vec3::Unit(axis);
      planes.push_back({normal, normal.dot(centre) + half[axis]});
    }
  }
  return corners_of(planes);
}

/// Along the longest edge slices as for a cylinder; across it pieces no longer than wide. A sphere
/// around the corners of the solid's part in each.
std::vector<Sphere> cover_mesh(const CollisionShape& shape, double max_excess) {
  const Vec3 edges = shape.size_m;
  double thin = thickness(edges, kThickestMeshM, max_excess);
  Eigen::Index longest = 0;
  edges.maxCoeff(&longest);
  const auto cut = [&] { return (edges / (1.5 * thin)).array().round().max(1.0).eval(); };
  while (cut().prod() > kMaxPieces) thin *= 1.5;
  Eigen::Vector3i pieces = cut().cast<int>();
  double across2 = 0.0;  // square of half a piece's diagonal across the longest edge
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == longest) continue;
    across2 += 0.25 * edges[axis] * edges[axis] / pieces[axis] / pieces[axis];
  }
  const double radius = std::sqrt(across2);
  const double stretch = std::sqrt((radius + max_excess) * (radius + max_excess) - across2);
  pieces[longest] =
      static_cast<int>(std::clamp(std::ceil(edges[longest] / (2.0 * stretch)), 1.0, kMaxPieces));

  const Vec3 piece = edges.cwiseQuotient(pieces.cast<double>());
  std::vector<Sphere> spheres;
  for (int x = 0; x < pieces.x(); ++x) {
    for (int y = 0; y < pieces.y(); ++y) {
      for (int z = 0; z < pieces.z(); ++z) {
        const Vec3 centre =
            (Vec3(x, y, z).array() + 0.5).matrix().cwiseProduct(piece) - edges / 2.0;
        const std::vector<Vec3> corners = corners_within(shape, centre, piece / 2.0);
        if (corners.empty()) continue;
        spheres.push_back(sphere_around(corners));
        spheres.back().radius_m += kRounding;
      }
    }
  }
  return spheres;
}

/// Direction in which the distance of `p_shape` from the shape grows.
Vec3 away_from(const CollisionShape& shape, const Vec3& p) {
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return p.squaredNorm() > 0.0 ? Vec3(p.normalized()) : Vec3(Vec3::UnitX());
    case ShapeKind::kCylinder: {
      const double across = p.head<2>().norm();
      const double radial = across - shape.size_m.x();
      const double axial = std::abs(p.z()) - shape.size_m.z() / 2.0;
      const Vec3 outwards =
          across > 0.0 ? Vec3(p.x() / across, p.y() / across, 0.0) : Vec3(Vec3::UnitX());
      const Vec3 upwards = Vec3::UnitZ() * (p.z() < 0.0 ? -1.0 : 1.0);
      if (radial <= 0.0 || axial <= 0.0) return radial > axial ? outwards : upwards;
      return (radial * outwards + axial * upwards).normalized();
    }
    case ShapeKind::kBox: {
      const Vec3 beyond = p.cwiseAbs() - shape.size_m / 2.0;
      Vec3 away = beyond.cwiseMax(0.0);
      if (away.squaredNorm() == 0.0) {
        Eigen::Index axis = 0;
        beyond.maxCoeff(&axis);
        away[axis] = 1.0;
      }
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] < 0.0) away[axis] = -away[axis];
      }
      return away.normalized();
    }
    case ShapeKind::kMesh:
      break;
  }
  Vec3 away = Vec3::UnitX();
  double farthest = -1e300;
  for (const auto& plane : shape.mesh->planes) {
    const double beyond = plane.normal.dot(p) - plane.offset_m;
    if (beyond <= farthest) continue;
    farthest = beyond;
    away = plane.normal;
  }
  return away;
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
    case ShapeKind::kMesh:
      spheres = cover_mesh(shape, max_excess_m);
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
    case ShapeKind::kMesh: {
      double farthest = -1e300;
      for (const auto& plane : shape.mesh->planes)
        farthest = std::max(farthest, plane.normal.dot(p_shape) - plane.offset_m);
      return farthest;
    }
  }
  return 0.0;
}

double cube_distance(const CollisionShape& shape, const Vec3& p_shape,
                     const Eigen::Matrix3d& R_shape_cube, double half_m) {
  const double distance = signed_distance(shape, p_shape);
  if (distance > 2.0 * half_m) return distance - std::sqrt(3.0) * half_m;  // near enough
  // The shape lies behind the plane across `away` at that distance; the cube reaches this far back.
  const Vec3 away = away_from(shape, p_shape);
  return distance - half_m * (R_shape_cube.transpose() * away).lpNorm<1>();
}

CoverQuality measure_cover(const std::vector<CollisionShape>& shapes,
                           const std::vector<Sphere>& spheres, int samples) {
  CoverQuality quality;
  if (spheres.empty()) return quality;
  Box box;
  for (const Sphere& sphere : spheres) {
    box.extend(sphere.centre + Vec3::Constant(sphere.radius_m));
    box.extend(sphere.centre - Vec3::Constant(sphere.radius_m));
  }
  std::vector<Pose> T_shape_link;
  for (const CollisionShape& shape : shapes) T_shape_link.push_back(shape.T_link_shape.inverse());
  const double step = std::cbrt(box.volume() / samples);
  const double cell = step * step * step;
  for (double x = box.min().x() + step / 2.0; x < box.max().x(); x += step) {
    for (double y = box.min().y() + step / 2.0; y < box.max().y(); y += step) {
      for (double z = box.min().z() + step / 2.0; z < box.max().z(); z += step) {
        const Vec3 p(x, y, z);
        double distance = 1e300;
        for (std::size_t i = 0; i < shapes.size(); ++i)
          distance = std::min(distance, signed_distance(shapes[i], T_shape_link[i] * p));
        const bool covered = std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& sphere) {
          return (p - sphere.centre).squaredNorm() <= sphere.radius_m * sphere.radius_m;
        });
        if (distance <= 0.0) quality.solid_m3 += cell;
        if (!covered) continue;
        quality.spheres_m3 += cell;
        quality.excess_m = std::max(quality.excess_m, distance);
      }
    }
  }
  return quality;
}

}  // namespace canopeer
