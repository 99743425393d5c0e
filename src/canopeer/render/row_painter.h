#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "canopeer/render/shading_kernels.h"
#include "canopeer/render/surface_plane.h"
#include "canopeer/render/visible_surface.h"

namespace canopeer {

/// A body as one view sees it, for shading.
struct PaintedBody {
  const SurfaceSoup* soup = nullptr;
  BodyRays rays;
  Eigen::Matrix3f R_world_body = Eigen::Matrix3f::Identity();
  float brightness = 1.0F;       ///< all its colours times this
  std::int16_t first_fruit = 0;  ///< number of its fruit 0
};

/// Memory of a ShadedRow, and which of its pixels are sky or structure.
class PaintedRow {
 public:
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  explicit PaintedRow(std::size_t width);
  [[nodiscard]] const ShadedRow& row() const { return row_; }
  [[nodiscard]] const std::vector<Range>& sky() const { return sky_; }
  [[nodiscard]] const std::vector<Range>& structure() const { return structure_; }

  /// Fills in all but the rays of row v from which triangle each pixel shows; writes its labels.
  void paint(std::span<const VisibleSurface> seen, const std::vector<PaintedBody>& bodies,
             const CameraRays& rays, int v, std::int16_t* fruit, std::uint8_t* kind);

 private:
  struct Run;
  void paint_sky(Range pixels);
  void paint_run(const Run& run);
  void paint_pixel(const Run& run, std::size_t u);
  void paint_base(const Run& run);

  std::vector<float> memory_;
  ShadedRow row_;
  std::vector<Range> sky_;
  std::vector<Range> structure_;
};

}  // namespace canopeer
