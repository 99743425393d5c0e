#pragma once

#include <optional>
#include <span>
#include <vector>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// The convex hull of points: the volume of a fruit whose mesh is open.
struct ConvexHull {
  /// The plane of a face.
  struct Plane {
    Vec3 normal;          ///< unit, outwards
    double offset = 0.0;  ///< normal · p + offset ≤ 0 inside
  };
  double volume_m3 = 0.0;
  double area_m2 = 0.0;
  Vec3 centroid = Vec3::Zero();                          ///< of the solid
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the solid about its centroid, m²
  std::vector<Vec3> vertices;
  std::vector<Plane> planes;

  /// Whether `p` lies inside or at most `margin_m` outside every plane.
  [[nodiscard]] bool contains(const Vec3& p, double margin_m = 0.0) const;
};

/// Nothing when the points lie in a plane or are fewer than four. Thread-safe.
[[nodiscard]] std::optional<ConvexHull> convex_hull(std::span<const Vec3> points);

}  // namespace canopeer
