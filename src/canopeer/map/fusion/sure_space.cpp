#include "canopeer/map/fusion/sure_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace canopeer {
namespace {

// Half sides of the windows, in pixels, in which the centres of a ray's voxels are looked for: the
// nearer the voxels, the larger. Each window is made of three of the one before that touch.
constexpr std::array<int, 13> kRadii = {3, 4, 5, 6, 8, 11, 15, 20, 27, 36, 54, 80, 120};
// A ball's image must hold this much more than the √½ pixels that lie between it and a pixel.
constexpr double kPixelsWithin = 0.75;
// Voxels to leave: as far as a voxel's centre may lie off a ray that crosses it, and more.
constexpr double kMarginVoxels = 1.0;
constexpr float kOutside = -1.0F;  // nothing is sure beyond the image

// Least of each pixel and those `shift` to both sides of it; the same with rows.
void widen_rows(const DepthImage& in, int shift, DepthImage& out) {
  const int width = in.width();
  for (int v = 0; v < in.height(); ++v) {
    const float* row = &in.at(0, v);
    float* to = &out.at(0, v);
    std::fill_n(to, std::min(shift, width), kOutside);
    for (int u = shift; u < width - shift; ++u) {
      to[u] = std::min(row[u], std::min(row[u - shift], row[u + shift]));
    }
    for (int u = std::max(shift, width - shift); u < width; ++u) to[u] = kOutside;
  }
}

void widen_columns(const DepthImage& in, int shift, DepthImage& out) {
  for (int v = 0; v < in.height(); ++v) {
    float* to = &out.at(0, v);
    if (v < shift || v + shift >= in.height()) {
      std::fill_n(to, in.width(), kOutside);
      continue;
    }
    const float* upper = &in.at(0, v - shift);
    const float* row = &in.at(0, v);
    const float* lower = &in.at(0, v + shift);
    for (int u = 0; u < in.width(); ++u) to[u] = std::min(row[u], std::min(upper[u], lower[u]));
  }
}

void widen(DepthImage& depth, int shift, DepthImage& scratch) {
  widen_rows(depth, shift, scratch);
  widen_columns(scratch, shift, depth);
}

// The depth from which on the centre of a voxel that a ray crosses falls at most `radius` pixels
// beside the ray's pixel (one for rounding and for where in its pixel it falls).
double nearest_depth(int radius, const CameraIntrinsics& k, double resolution_m) {
  const double x = std::max(k.cx, k.width - k.cx) / k.fx;
  const double y = std::max(k.cy, k.height - k.cy) / k.fy;
  const double off_ray = 0.5 * std::numbers::sqrt3 * resolution_m;
  const double slant = std::sqrt(1.0 + x * x + y * y);
  return std::max(k.fx, k.fy) * off_ray * slant / (radius - 1.0) + off_ray;
}

// Takes the depths between `nearest` and `farthest` in where the window of each pixel is sure up to
// there. From the far bands to the near ones: what is sure must hang together.
void extend(const DepthImage& window, float nearest, float farthest, SureSpace& sure) {
  const std::size_t count = window.pixels().size();
  const float* least = window.pixels().data();
  float* from = sure.from.pixels().data();
  float* to = sure.to.pixels().data();
  for (std::size_t i = 0; i < count; ++i) {
    const bool starts = to[i] == 0.0F && least[i] > nearest;
    const bool goes_on = from[i] == farthest && least[i] >= farthest;
    to[i] = starts ? std::min(least[i], farthest) : to[i];
    from[i] = starts || goes_on ? nearest : from[i];
  }
}

}  // namespace

SureSpace find_sure_space(const DepthImage& free_depth, const CameraIntrinsics& k,
                          double resolution_m) {
  const int width = free_depth.width(), height = free_depth.height();
  SureSpace sure{free_depth, DepthImage(width, height), DepthImage(width, height)};
  const auto farthest =
      static_cast<float>(0.5 * resolution_m * std::min(k.fx, k.fy) / kPixelsWithin);
  const auto beyond = static_cast<float>(2.0 * resolution_m);  // a voxel's diagonal, and more
  for (float& depth : sure.depth.pixels()) {
    depth = std::max(0.0F, std::min(depth - beyond, farthest));
  }
  DepthImage window = sure.depth, scratch(width, height);
  int radius = 1;
  widen(window, radius, scratch);
  float band_end = std::numeric_limits<float>::max();
  for (const int next : kRadii) {
    widen(window, next - radius, scratch);
    radius = next;
    const auto nearest = static_cast<float>(nearest_depth(radius, k, resolution_m));
    extend(window, nearest, band_end, sure);
    band_end = nearest;
  }
  const auto margin = static_cast<float>(kMarginVoxels * resolution_m);
  for (std::size_t i = 0; i < sure.to.pixels().size(); ++i) {
    float& from = sure.from.pixels()[i];
    float& to = sure.to.pixels()[i];
    from += margin;
    to = std::max(from, to - margin);
  }
  return sure;
}

}  // namespace canopeer
