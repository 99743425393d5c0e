#include "canopeer/sensing/coarse_depth.h"

#include <algorithm>

namespace canopeer {
namespace {

constexpr float kOneSurface = 0.06F;  // within one pixel's surface, of the depth

/// 0: none.
float mean_depth(const DepthImage& depth, int u0, int v0, int step) {
  float sum = 0.0F, nearest = 0.0F, farthest = 0.0F;
  int count = 0;
  for (int v = v0; v < v0 + step; ++v) {
    for (int u = u0; u < u0 + step; ++u) {
      const float d = depth.at(u, v);
      if (!(d > 0.0F)) continue;
      sum += 1.0F / d;
      nearest = count == 0 ? d : std::min(nearest, d);
      farthest = std::max(farthest, d);
      ++count;
    }
  }
  if (2 * count < step * step || farthest > (1.0F + kOneSurface) * nearest) return 0.0F;
  return static_cast<float>(count) / sum;
}

}  // namespace

CoarseDepth coarse_depth(const CameraIntrinsics& intrinsics, const DepthImage& depth, int step) {
  CoarseDepth coarse;
  CameraIntrinsics& k = coarse.intrinsics = intrinsics;
  k.width /= step;
  k.height /= step;
  for (double* length_px : {&k.fx, &k.fy, &k.cx, &k.cy}) *length_px /= step;
  coarse.depth = DepthImage(k.width, k.height);
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      coarse.depth.at(u, v) = mean_depth(depth, u * step, v * step, step);
    }
  }
  return coarse;
}

}  // namespace canopeer
