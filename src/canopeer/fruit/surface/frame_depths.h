#pragma once

#include <cstddef>
#include <vector>

#include "canopeer/base/simd_level.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// A frame's depths as voxels ask for them. Kept from frame to frame, so that its memory is there
/// already.
class FrameDepths {
 public:
  /// A pixel with a step in depth of more than `max_step_m` beside it is at an edge; so are those
  /// of the image's rim. `level`: changes the speed only.
  void set(const DepthImage& depth, float max_range_m, float max_step_m,
           SimdLevel level = best_simd_level());

  /// Rows of the image, with one pixel more before and behind, and one row more above and below. So
  /// voxels just outside of the image need no question of their own. 0: no depth. Negative: the
  /// pixel is at an edge, or too far away to show a surface; it only tells what is free before it.
  [[nodiscard]] const float* marked() const { return marked_.data(); }
  [[nodiscard]] std::ptrdiff_t stride() const { return width_ + 2; }

  /// Upper bound on the depths of the pixels in a rectangle, m: the largest in each tile of the
  /// image that it touches; 0 when it touches none. Pixel coordinates, both ends included; they may
  /// lie outside of the image.
  [[nodiscard]] float farthest(double u_low, double v_low, double u_high, double v_high) const;

 private:
  static constexpr int kTile = 8;

  int width_ = 0;
  int height_ = 0;
  int tile_columns_ = 0;
  int tile_rows_ = 0;
  std::vector<float> marked_;
  std::vector<float> farthest_;      // by tile
  std::vector<float> farthest_row_;  // by column of pixels, of one row of tiles
};

}  // namespace canopeer
