#include "canopeer/map/depth_pyramid.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

// Windows of 128 pixels: what spans more is so near that it is better looked at in parts.
constexpr int kTop = 7;

using Halve = void (*)(const float*, const float*, std::size_t, float*);
using Widen = void (*)(const float*, const float*, std::size_t, std::size_t, float*);

// Level 1: the 2 × 2 pixels of each window; an odd row or column out pairs with itself.
void halve(const DepthImage& depth, int wide, int high, Halve kernel, float* out) {
  const auto pairs = static_cast<std::size_t>(depth.width() / 2);
  for (int j = 0; j < high; ++j) {
    const float* upper = &depth.at(0, 2 * j);
    const float* lower = &depth.at(0, std::min(2 * j + 1, depth.height() - 1));
    float* row = out + static_cast<std::size_t>(j) * static_cast<std::size_t>(wide);
    kernel(upper, lower, pairs, row);
    if (depth.width() % 2 == 0) continue;
    const float last_upper[2] = {upper[2 * pairs], upper[2 * pairs]};
    const float last_lower[2] = {lower[2 * pairs], lower[2 * pairs]};
    kernel(last_upper, last_lower, 1, row + pairs);
  }
}

// A window of twice the side is four of these, `shift` windows apart; none lies outside the image.
void widen(const float* level, int wide, int high, int shift, Widen kernel, float* out) {
  const auto width = static_cast<std::size_t>(wide);
  const auto apart = static_cast<std::size_t>(std::min(shift, wide - 1));
  for (int j = 0; j < high; ++j) {
    const float* upper = level + static_cast<std::size_t>(j) * width;
    const float* lower = level + static_cast<std::size_t>(std::min(j + shift, high - 1)) * width;
    float* row = out + static_cast<std::size_t>(j) * width;
    kernel(upper, lower, apart, width - apart, row);
    // The last ones reach the image's border: those beside them do, too.
    for (std::size_t i = width - apart; i < width; ++i) {
      kernel(upper + i, lower + i, width - 1 - i, 1, row + i);
    }
  }
}

}  // namespace

DepthPyramid::DepthPyramid(const DepthImage& depth, const CameraIntrinsics& k,
                           const FrameKernels& kernels) {
  CANOPEER_CHECK(!depth.empty(), "a depth pyramid needs an image");
  const int wide = (depth.width() + 1) / 2;
  const int high = (depth.height() + 1) / 2;
  const std::size_t level = static_cast<std::size_t>(wide) * static_cast<std::size_t>(high);
  CANOPEER_CHECK(level * kTop < (std::size_t{1} << 31), "the depth image is too large");
  min_.resize(level * kTop);
  max_.resize(level * kTop);
  halve(depth, wide, high, kernels.halve_min, min_.data());
  halve(depth, wide, high, kernels.halve_max, max_.data());
  for (int l = 1; l < kTop; ++l) {
    const std::size_t below = static_cast<std::size_t>(l - 1) * level;
    const int shift = 1 << (l - 1);  // half a window, in windows
    widen(&min_[below], wide, high, shift, kernels.widen_min, &min_[below + level]);
    widen(&max_[below], wide, high, shift, kernels.widen_max, &max_[below + level]);
  }
  flat_.width = depth.width();
  flat_.height = depth.height();
  flat_.fx = static_cast<float>(k.fx);
  flat_.fy = static_cast<float>(k.fy);
  flat_.cx = static_cast<float>(k.cx);
  flat_.cy = static_cast<float>(k.cy);
  flat_.depth = depth.pixels().data();
  flat_.min = min_.data();
  flat_.max = max_.data();
  flat_.top = kTop;
  flat_.wide = wide;
  flat_.level_size = static_cast<std::int32_t>(level);
  flat_.largest =
      *std::max_element(max_.begin(), max_.begin() + static_cast<std::ptrdiff_t>(level));
}

}  // namespace canopeer
