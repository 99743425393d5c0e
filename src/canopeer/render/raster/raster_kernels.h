#pragma once

#include <cstddef>
#include <cstdint>

#include "canopeer/base/simd_level.h"

namespace canopeer {

/// The part of the picture that is drawn now, and what each of its pixels shows so far. The buffers
/// are those of the whole picture.
struct RasterWindow {
  int first_column = 0, last_column = 0;  ///< pixels
  int first_row = 0, last_row = 0;
  double cx = 0.0, cy = 0.0;  ///< principal point, pixels
  /// Per column, and some beyond the last: its centre less cx, pixels.
  const float* column_centre = nullptr;
  /// 1 / depth of the nearest surface, 0: none; `stride` apart row by row, and at least
  /// kRasterLanes pixels longer than the picture.
  float* nearness = nullptr;
  std::uint32_t* surface = nullptr;  ///< what it is
  std::size_t stride = 0;
};

inline constexpr std::size_t kRasterLanes = 16;

/// A group of triangles to be drawn.
struct RasterCluster {
  const float* x = nullptr;  ///< vertices, model frame; their number is a multiple of kRasterLanes
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t vertices = 0;
  const std::uint8_t* corners = nullptr;  ///< three vertices a triangle
  std::size_t triangles = 0;
  std::uint32_t first_surface = 0;  ///< triangle i is written as first_surface + i
  /// A model's point p as seen from the camera is turn · (p − eye) + shift: (x, y) in pixels off
  /// the principal point and times its depth, and the depth. Row by row.
  float turn[9] = {};
  float eye[3] = {};
  float shift[3] = {};
  /// Whether triangle i has a surface where the ray of a pixel meets it; null: everywhere.
  bool (*solid)(const void* context, std::size_t triangle, int column, int row) = nullptr;
  const void* context = nullptr;
};

/// The rasteriser's inner loops for one instruction set. Every level writes the same bits.
struct RasterKernels {
  /// Draws a group; false when no pixel changed.
  bool (*draw)(const RasterCluster& cluster, const RasterWindow& window);
};

const RasterKernels& raster_kernels(SimdLevel level);

}  // namespace canopeer
