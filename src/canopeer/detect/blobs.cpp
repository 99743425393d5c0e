#include "canopeer/detect/blobs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canopeer {
namespace {

void add_pixel(Blob& blob, const CameraIntrinsics& camera, float depth) {
  ++blob.pixels;
  blob.area_cm2 += 1e4 * depth * depth / (camera.fx * camera.fy);
}

}  // namespace

BlobLabels label_blobs(const RgbdFrame& frame, const Mask& mask, double depth_step_m) {
  BlobLabels result{Image<int>(mask.width(), mask.height(), -1), {}};
  std::vector<std::pair<int, int>> open;
  for_each_pixel_in(mask, [&](int u0, int v0) {
    if (result.label.at(u0, v0) >= 0) return;
    const int label = static_cast<int>(result.blobs.size());
    Blob& blob = result.blobs.emplace_back();
    result.label.at(u0, v0) = label;
    open.emplace_back(u0, v0);
    while (!open.empty()) {
      const auto [u, v] = open.back();
      open.pop_back();
      const float depth = frame.depth.at(u, v);
      add_pixel(blob, frame.intrinsics, depth);
      for (int nv = std::max(v - 1, 0); nv <= std::min(v + 1, mask.height() - 1); ++nv) {
        for (int nu = std::max(u - 1, 0); nu <= std::min(u + 1, mask.width() - 1); ++nu) {
          if (mask.at(nu, nv) == 0 || result.label.at(nu, nv) >= 0) continue;
          if (std::abs(frame.depth.at(nu, nv) - depth) > depth_step_m) continue;
          result.label.at(nu, nv) = label;
          open.emplace_back(nu, nv);
        }
      }
    }
  });
  return result;
}

}  // namespace canopeer
