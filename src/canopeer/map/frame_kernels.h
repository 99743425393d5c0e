#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "canopeer/base/simd_level.h"
#include "canopeer/map/block.h"

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

/// A pinhole camera in single precision, and the smallest and largest depths of windows of 2^l ×
/// 2^l pixels (levels 1 … top) that start at every second pixel: `wide` windows a row, all levels
/// in one array, `level_size` items apart. Any rectangle up to 2^(top + 1) − 2 pixels wide is
/// covered nearly tightly by four windows that overlap.
struct FlatPyramid {
  int width = 0, height = 0;
  float fx = 0, fy = 0, cx = 0, cy = 0;
  const float* depth = nullptr;  ///< level 0, row-major
  /// Two numbers a window, smallest and −largest: one look-up, and the least of both is wanted.
  const float* bounds = nullptr;
  int top = 1;
  std::int32_t wide = 0;        ///< windows a row
  std::int32_t level_size = 0;  ///< windows a level; level 1 starts at 0
  float largest = 0;            ///< depth of all
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

/// Bit i: cube i. The rest must be looked at voxel by voxel.
struct CubeViews {
  std::uint64_t none_free = 0;
  std::uint64_t all_free = 0;
};

/// How the centres of a block's voxels come into the camera frame, m.
struct BlockProjection {
  std::array<std::array<double, 4>, 3> rows{};  ///< of T_camera_world
  double resolution_m = 0.0;
  /// Where the 16 voxels of a slice of a half block (4 × 4, x fastest) are from the first.
  alignas(64) std::array<float, 16> x{};
  alignas(64) std::array<float, 16> y{};
  alignas(64) std::array<float, 16> z{};
};

/// The eight half blocks (4 × 4 × 4 voxels; x, y, z of the half from the lowest bit on) of a block,
/// as far as they are decided.
struct DecidedHalves {
  unsigned none_free = 0;
  unsigned all_free = 0;
};

/// What fusing a frame spends its time in, for one instruction set. None of them gathers: on many
/// processors that is slower than loads one by one.
struct FrameKernels {
  void (*end_point_row)(const PixelRow& row, const PixelRowEnds& ends);
  /// out[2 i] and [2 i + 1] = least and −largest of upper and lower [2 i], [2 i + 1], for `count`
  /// windows.
  void (*halve)(const float* upper, const float* lower, std::size_t count, float* out);
  /// out[i] = least of upper and lower [i], [i + shift], for `count` items.
  void (*widen)(const float* upper, const float* lower, std::size_t shift, std::size_t count,
                float* out);
  /// Never wrong, not always decided.
  CubeViews (*classify)(const FlatPyramid& pyramid, const CubeLanes& cubes);
  /// The voxels whose centres are seen nearer than the depth at their pixel, of the block with the
  /// lowest voxel `corner`.
  VoxelMask (*free_in_block)(const FlatPyramid& pyramid, const BlockProjection& projection,
                             const std::array<int, 3>& corner, const DecidedHalves& decided);
};

/// `level` must be one the machine has.
const FrameKernels& frame_kernels(SimdLevel level);

}  // namespace canopeer
