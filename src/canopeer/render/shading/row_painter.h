#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "canopeer/render/raster/visible_surface.h"
#include "canopeer/render/shading/shading_kernels.h"
#include "canopeer/render/surfaces/surface_plane.h"

namespace canopeer {

/// A body as one view sees it, for shading.
struct PaintedBody {
  const SurfaceSoup* soup = nullptr;
  BodyRays rays;
  Eigen::Matrix3f R_world_body = Eigen::Matrix3f::Identity();
  float brightness = 1.0F;       ///< all its colours times this
  std::int16_t first_fruit = 0;  ///< number of its fruit 0
};

/// Fills in what shading needs of rows of pixels, from which triangle each of them shows. One for
/// each thread.
class RowPainter {
 public:
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  /// All of them outlive the painter.
  RowPainter(const std::vector<PaintedBody>& bodies, const CameraRays& rays);
  ~RowPainter();
  RowPainter(const RowPainter&) = delete;
  RowPainter& operator=(const RowPainter&) = delete;

  [[nodiscard]] const ShadedRow& row() const { return row_; }
  /// Pixels of the last row painted that show the sky, and those that show structure.
  [[nodiscard]] const std::vector<Range>& sky() const { return sky_; }
  [[nodiscard]] const std::vector<Range>& structure() const { return structure_; }

  /// All of row v but its rays; and its labels.
  void paint(std::span<const VisibleRun> runs, int v, std::int16_t* fruit, std::uint8_t* kind);

 private:
  struct Triangle;
  struct Shades;
  const Triangle& prepared(VisibleSurface surface);
  void paint_sky(Range pixels);
  void paint_run(const Triangle& triangle, Range pixels, int v);
  void paint_pixel(const Triangle& triangle, std::size_t u, const Vec3& sides);
  void fill(const Shades& shades, Range pixels);

  const std::vector<PaintedBody>& bodies_;
  const CameraRays& rays_;
  std::vector<Triangle> triangles_;   // those seen lately: most are seen again in the next row
  std::vector<VisibleSurface> kept_;  // which
  std::vector<float> memory_;
  ShadedRow row_;
  std::vector<Range> sky_;
  std::vector<Range> structure_;
};

}  // namespace canopeer
