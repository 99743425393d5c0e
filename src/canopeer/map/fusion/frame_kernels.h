#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "canopeer/base/simd_level.h"
#include "canopeer/map/storage/block.h"

namespace canopeer {

/// A row of pixels on its way to voxels; arrays of `width` items. What depends on the column only
/// is shared by all rows.
struct PixelRow {
  std::size_t width = 0;
  const float* depth = nullptr;      ///< m along the axis; anything
  const double* across_x = nullptr;  ///< R · (x of the column's ray, 0, 0), world
  const double* across_y = nullptr;
  const double* across_z = nullptr;
  const double* across2 = nullptr;  ///< (x of the column's ray)²
  std::array<double, 3> along{};    ///< R · (0, y of the row's ray, 1), world
  double along2 = 0.0;              ///< 1 + (y of the row's ray)²
  std::array<double, 3> origin{};   ///< of the camera, world
  double max_range_m = 0.0;         ///< Euclidean
  double resolution_m = 0.0;
  bool clear_no_return = false;
};

/// What comes out of it, arrays of `width` items.
struct PixelRowEnds {
  float* free_depth = nullptr;  ///< m along the axis up to which the ray is free; 0: nowhere
  std::int32_t* x = nullptr;    ///< voxel of the end point, where there is one
  std::int32_t* y = nullptr;
  std::int32_t* z = nullptr;
  std::int32_t* is_end = nullptr;  ///< 1: the pixel has an end point
};

/// A row of end points and the row above, and what tells pixels of one voxel apart.
struct LabelledRow {
  std::size_t width = 0;
  PixelRowEnds ends, above;
  const std::uint8_t* mask = nullptr;  ///< of the pixels; nullptr: none
  std::uint8_t most = 1;               ///< mask values above count as this
  std::int32_t* label = nullptr;       ///< to be written: 0 without end point, 1 + the mask's value
  const std::int32_t* label_above = nullptr;
};

/// A pinhole camera in single precision, and the smallest and largest depths of windows of 2^l ×
/// 2^l pixels (levels 1 … top) that start at every second pixel. A row has `wide` windows; all
/// levels lie in one array, `level_size` items apart. Four windows that overlap cover any rectangle
/// up to 2^(top + 1) − 2 pixels wide nearly tightly.
struct FlatPyramid {
  int width = 0, height = 0;
  float fx = 0, fy = 0, cx = 0, cy = 0;
  const float* depth = nullptr;  ///< level 0, row-major
  float largest = 0;             ///< depth of all
  /// min(depth · coarse_scale, 65535) rounded down, row-major, 32 more at the end. Rounding keeps
  /// order: what differs in these differs likewise in depth.
  const std::uint16_t* coarse_depth = nullptr;
  float coarse_scale = 0;
  /// Of coarse depths, two numbers a window, smallest and 65535 − largest: one look-up, and the
  /// least of both is wanted.
  const std::uint16_t* bounds = nullptr;
  int top = 1;
  std::int32_t wide = 0;        ///< windows a row
  std::int32_t level_size = 0;  ///< windows a level; level 1 starts at 0
};

/// Up to 64 cubes of one size, spanned by their voxels' centres; camera frame, m.
/// Lanes beyond `count` hold anything finite.
struct CubeLanes {
  static constexpr std::size_t kMax = 64;
  std::size_t count = 0;                  ///< a multiple of 8
  alignas(64) std::array<float, kMax> x;  ///< centres
  alignas(64) std::array<float, kMax> y;
  alignas(64) std::array<float, kMax> z;
  /// Half edges, camera frame: the centres' distance from the farthest voxels' on each map axis.
  std::array<std::array<float, 3>, 3> edges{};
  float half = 0;  ///< half the depth they span
};

/// Bit i: cube i. What is neither free nor not must be looked at voxel by voxel.
struct CubeViews {
  std::uint64_t none_free = 0;
  std::uint64_t all_free = 0;
  std::uint64_t apart = 0;  ///< wholly in front of the camera, clear of it
};

/// The pixels that the centres of a cube's voxels can fall on, as far as they are in the image:
/// columns u0 … u1, rows v0 … v1.
struct PixelRects {
  using Lanes = std::array<std::int32_t, CubeLanes::kMax>;
  alignas(64) Lanes u0;
  alignas(64) Lanes v0;
  alignas(64) Lanes u1;
  alignas(64) Lanes v1;
  /// The depths these voxels lie between, bounds that may be a little off the voxels.
  alignas(64) std::array<float, CubeLanes::kMax> near;
  alignas(64) std::array<float, CubeLanes::kMax> far;
};

/// How the centres of a block's voxels come into the camera frame, m.
struct BlockProjection {
  std::array<std::array<double, 4>, 3> rows{};  ///< of T_camera_world
  double resolution_m = 0.0;
  /// Where the 16 voxels of a slice of a half block (4 × 4, x fastest) are from the first.
  alignas(64) std::array<float, 16> x{};
  alignas(64) std::array<float, 16> y{};
  alignas(64) std::array<float, 16> z{};
  float z_least = 0, z_most = 0;  ///< of z
};

/// What is known of the eight half blocks of a block (4 × 4 × 4 voxels; x, y, z of the half from
/// the lowest bit on). They are the cubes 8 · place … 8 · place + 7 of `views`.
struct HalfBlocks {
  const CubeViews& views;
  const PixelRects& rects;
  std::size_t place = 0;

  [[nodiscard]] unsigned none_free() const { return bits(views.none_free); }
  [[nodiscard]] unsigned all_free() const { return bits(views.all_free); }
  [[nodiscard]] unsigned apart() const { return bits(views.apart); }
  [[nodiscard]] unsigned undecided() const { return ~(none_free() | all_free()) & 0xFF; }
  [[nodiscard]] unsigned bits(std::uint64_t of_all) const {
    return static_cast<unsigned>(of_all >> (8 * place) & 0xFF);
  }
};

/// What fusing a frame spends its time in, for one instruction set. None of them gathers: on many
/// processors that is slower than loads one by one.
struct FrameKernels {
  void (*end_point_row)(const PixelRow& row, const PixelRowEnds& ends);
  /// Bit u % 64 of first[u / 64] is set when pixel u has an end point, and neither the pixel to the
  /// left nor the one above ends in the same voxel with the same label.
  void (*first_pixels)(const LabelledRow& row, std::uint64_t* first);
  /// out[i] = min(depth[i] · scale, 65535) rounded down; no depth is negative.
  void (*coarsen)(const float* depth, std::size_t count, float scale, std::uint16_t* out);
  /// out[2 i] and [2 i + 1] = least and 65535 − largest of upper and lower [2 i], [2 i + 1], for
  /// `count` windows.
  void (*halve)(const std::uint16_t* upper, const std::uint16_t* lower, std::size_t count,
                std::uint16_t* out);
  /// out[i] = least of upper and lower [i], [i + shift], for `count` items.
  void (*widen)(const std::uint16_t* upper, const std::uint16_t* lower, std::size_t shift,
                std::size_t count, std::uint16_t* out);
  /// Never wrong, not always decided.
  CubeViews (*classify)(const FlatPyramid& pyramid, const CubeLanes& cubes, PixelRects& rects);
  /// The voxels whose centres are seen nearer than the depth at their pixel, of the block with the
  /// lowest voxel `corner`.
  VoxelMask (*free_in_block)(const FlatPyramid& pyramid, const BlockProjection& projection,
                             const std::array<int, 3>& corner, const HalfBlocks& halves);
};

/// `level` must be one the machine has.
const FrameKernels& frame_kernels(SimdLevel level);

}  // namespace canopeer
