#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/base/simd_level.h"
#include "canopeer/render/raster/cluster_queue.h"
#include "canopeer/render/raster/depth_tiles.h"
#include "canopeer/render/raster/visible_surface.h"

namespace canopeer {

/// Which triangle each pixel of a view shows.
class VisibleImage {
 public:
  VisibleImage(int width, int height) : width_(width), tiles_(width, height) {}

  /// What row v shows, from the left; `runs` is overwritten.
  void row(int v, std::vector<VisibleRun>* runs) const;
  /// 1 / depth of what the pixels of row v show, 1/m; 0: nothing.
  [[nodiscard]] const float* nearness_row(int v) const { return tiles_.nearness_row(v); }

 private:
  friend class Rasterizer;
  // A surface's number: place in the queue · 64 + triangle of the group.
  static constexpr std::uint32_t kPerCluster = TriangleClusters::kMaxTriangles;

  int width_;
  DepthTiles tiles_;
  std::vector<QueuedCluster> queue_;
  const std::vector<RasterBody>* bodies_ = nullptr;
};

/// Finds the nearest triangle at every pixel centre of a pinhole camera. It draws all that may be
/// seen, the nearest groups of triangles first, and what is hidden not at all.
class Rasterizer {
 public:
  /// Soups and groups outlive the rasteriser.
  explicit Rasterizer(std::vector<RasterBody> bodies, SimdLevel level = best_simd_level())
      : bodies_(std::move(bodies)), level_(level) {}

  [[nodiscard]] const std::vector<RasterBody>& bodies() const { return bodies_; }
  /// The image must not outlive the rasteriser. Thread-safe; the same arguments give the same image
  /// with any number of threads and at any level.
  [[nodiscard]] VisibleImage draw(const CameraIntrinsics& camera, const Pose& T_world_camera) const;
  /// The same image at pixels that the first body covers, hidden there or not; all others show
  /// nothing. What is deeper than `far_m` may be left out. Much quicker where that body is small in
  /// the picture. In the calling thread.
  [[nodiscard]] VisibleImage draw_first_body(const CameraIntrinsics& camera,
                                             const Pose& T_world_camera, float far_m) const;

 private:
  [[nodiscard]] std::vector<BodyView> places_of(const CameraIntrinsics& camera,
                                                const Pose& T_world_camera) const;

  std::vector<RasterBody> bodies_;
  SimdLevel level_;
};

}  // namespace canopeer
