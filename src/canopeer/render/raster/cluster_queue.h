#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "canopeer/render/raster/depth_tiles.h"
#include "canopeer/render/raster/triangle_clusters.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// Something to be drawn: the world, or a model in its place.
struct RasterBody {
  const SurfaceSoup* soup = nullptr;
  const TriangleClusters* clusters = nullptr;
  Pose T_world_body = Pose::Identity();
};

/// Where a body is from a camera. Its points p are at turn · (p − eye) + shift: first (x, y) in
/// pixels off the principal point and times the depth, then the depth. Taking the eye off first
/// keeps the digits of points near the camera, wherever in the world both are.
struct BodyView {
  Eigen::Matrix3f turn;
  Eigen::Vector3f eye;
  Eigen::Vector3f shift;
};
BodyView body_view(const RasterBody& body, const CameraIntrinsics& camera,
                   const Pose& T_world_camera);

/// A group of triangles that may be seen.
struct QueuedCluster {
  std::uint32_t body = 0;
  std::uint32_t cluster = 0;
  PixelBox box;           ///< pixels it can cover
  float nearness = 0.0F;  ///< no part of it is nearer: 1 / depth, 1/m
};

/// What of the bodies may be in a view, the nearest first. `views` has one entry per body. What is
/// deeper than `far_m` as a whole is left out.
std::vector<QueuedCluster> queue_clusters(const std::vector<RasterBody>& bodies,
                                          const std::vector<BodyView>& views,
                                          const CameraIntrinsics& camera,
                                          float far_m = std::numeric_limits<float>::infinity());

}  // namespace canopeer
