#pragma once

#include "canopeer/render/surfaces/surface_soup.h"
#include "canopeer/sensing/camera_rays.h"

namespace canopeer {

/// Rays of a camera in a body's frame, in double precision. They go from `eye` along right · x +
/// down · y + ahead, where (x, y, 1) is a pixel's ray in the camera's frame.
struct BodyRays {
  BodyRays() = default;
  BodyRays(const Pose& T_world_body, const Pose& T_world_camera) {
    const Pose T_body_camera = T_world_body.inverse(Eigen::Isometry) * T_world_camera;
    eye = T_body_camera.translation();
    right = T_body_camera.linear().col(0);
    down = T_body_camera.linear().col(1);
    ahead = T_body_camera.linear().col(2);
  }
  [[nodiscard]] Vec3 direction(double x, double y) const { return x * right + (y * down + ahead); }

  Vec3 eye = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), down = Vec3::UnitY(), ahead = Vec3::UnitZ();
};

/// A triangle as rays from one eye meet it.
struct SurfacePlane {
  SurfacePlane(const SurfaceSoup& soup, std::uint32_t triangle, const Vec3& eye) {
    const auto& t = soup.triangles[triangle].vertex;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = soup.vertices[t[i]].cast<double>() - eye;
    for (std::size_t i = 0; i < 3; ++i) edge[i] = corner[(i + 1) % 3].cross(corner[(i + 2) % 3]);
  }

  /// Weights of the corners where the ray meets the plane; they may be a little below 0 at an edge.
  /// Their sum is 1 unless the ray does not meet it.
  [[nodiscard]] Vec3 weights(const Vec3& direction) const {
    const Vec3 w(edge[0].dot(direction), edge[1].dot(direction), edge[2].dot(direction));
    return w / w.sum();
  }
  /// Weights of a point of the triangle itself, for rays that graze it or pass it by a rounding.
  [[nodiscard]] Vec3 weights_inside(const Vec3& direction) const {
    const Vec3 w = weights(direction);
    if (!w.allFinite()) return Vec3::Constant(1.0 / 3.0);
    const Vec3 held = w.cwiseMax(0.0);
    return held / held.sum();
  }

  std::array<Vec3, 3> corner;  ///< as seen from the eye
  std::array<Vec3, 3> edge;    ///< normals of the planes through the eye and the edges
};

}  // namespace canopeer
