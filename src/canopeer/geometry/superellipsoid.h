#pragma once

#include <vector>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// A point of a surface with its unit normal, pointing out of the body; world.
struct SurfacePoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(point, normal);
  }
};

/// A superellipsoid in the world (Barr 1981; Solina & Bajcsy 1990). In the body frame it holds the
/// points with F = (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) ≤ 1. e1 = e2 = 1 is an
/// ellipsoid; smaller exponents are blockier. Semi-axes positive, exponents in (0, 2).
struct Superellipsoid {
  Vec3 semi_axes_m = Vec3::Constant(0.03);  ///< a, b, c
  double e1 = 1.0;                          ///< along the axis
  double e2 = 1.0;                          ///< across it
  Pose T_world_body = Pose::Identity();

  [[nodiscard]] Vec3 centre() const { return T_world_body.translation(); }

  /// F^(e1/2) at a point of the world: grows along each ray from the centre in proportion to the
  /// distance from it, 1 on the surface.
  [[nodiscard]] double gauge(const Vec3& p_world) const;

  /// Signed distance to the surface along the ray from the centre through p (world), m; negative
  /// inside. At the centre itself: minus the smallest semi-axis.
  [[nodiscard]] double radial_distance(const Vec3& p_world) const;

  /// Outward unit normal of the level set through p (world); z of the body at the centre.
  [[nodiscard]] Vec3 normal_at(const Vec3& p_world) const;

  /// 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2), m³ (Jaklič, Leonardis & Solina 2000, eq. 2.60).
  [[nodiscard]] double volume_m3() const;

  /// Points of the surface with normals, world, in the directions of a Fibonacci lattice on the
  /// sphere stretched to the semi-axes; `count` of them.
  [[nodiscard]] std::vector<SurfacePoint> surface_samples(int count) const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(semi_axes_m, e1, e2, T_world_body);
  }
};

/// Evenly spread directions: the Fibonacci lattice on the unit sphere.
[[nodiscard]] std::vector<Vec3> fibonacci_directions(int count);

/// R = Rz(yaw) Ry(pitch) Rx(roll) from (roll, pitch, yaw), and back with pitch in [−π/2, π/2].
[[nodiscard]] Eigen::Matrix3d rotation_of(const Vec3& roll_pitch_yaw_rad);
[[nodiscard]] Vec3 roll_pitch_yaw_of(const Eigen::Matrix3d& rotation);

}  // namespace canopeer
