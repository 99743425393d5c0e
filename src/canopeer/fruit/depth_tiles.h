#pragma once

#include <vector>

#include "canopeer/sensing/image.h"

namespace canopeer {

/// The largest depth in each tile of an image: what lies behind it in a tile, no pixel there sees.
class DepthTiles {
 public:
  explicit DepthTiles(const DepthImage& depth);

  /// Largest depth of the tiles that the rectangle touches, m; 0 when none does. Pixel coordinates,
  /// both ends included; they may lie outside of the image.
  [[nodiscard]] float farthest(double u_low, double v_low, double u_high, double v_high) const;

 private:
  static constexpr int kSide = 8;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> farthest_;
};

}  // namespace canopeer
