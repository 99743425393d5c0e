#pragma once

#include <vector>

#include "canopeer/sensing/image.h"

namespace canopeer {

/// Range of depths in any rectangle of an image in constant time: each level holds minimum and
/// maximum of 2 × 2 cells of the one below.
class DepthPyramid {
 public:
  struct Range {
    float min;
    float max;
  };

  /// `depth` must not be empty nor hold NaN.
  explicit DepthPyramid(const DepthImage& depth);

  /// Bounds on the depths of the pixels u0 … u1, v0 … v1 (inclusive, within the image): never
  /// tighter than the truth, equal to it for rectangles of a few pixels.
  [[nodiscard]] Range range(int u0, int v0, int u1, int v1) const;
  /// The largest depth of the image.
  [[nodiscard]] float max() const { return levels_.back().at(0, 0).max; }

 private:
  std::vector<Image<Range>> levels_;
};

}  // namespace canopeer
