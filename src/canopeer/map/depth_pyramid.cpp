#include "canopeer/map/depth_pyramid.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <utility>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

// Windows of 128 pixels: what spans more is so near that it is better looked at in parts.
constexpr int kTop = 7;
constexpr std::size_t kCoarseBeyond = 32;
// What the thread's last pyramid lay in; the next one is as large, as a rule.
thread_local HugeMemory last_memory;
constexpr float kLeastCoarse = 0.01F;  // m

// Level 1: the 2 × 2 pixels of each window; an odd row or column out pairs with itself.
void halve(const DepthImage& depth, int wide, int high, const FrameKernels& kernels, float* out) {
  const auto pairs = static_cast<std::size_t>(depth.width() / 2);
  for (int j = 0; j < high; ++j) {
    const float* upper = &depth.at(0, 2 * j);
    const float* lower = &depth.at(0, std::min(2 * j + 1, depth.height() - 1));
    float* row = out + 2 * static_cast<std::size_t>(j) * static_cast<std::size_t>(wide);
    kernels.halve(upper, lower, pairs, row);
    if (depth.width() % 2 == 0) continue;
    const float last_upper[2] = {upper[2 * pairs], upper[2 * pairs]};
    const float last_lower[2] = {lower[2 * pairs], lower[2 * pairs]};
    kernels.halve(last_upper, last_lower, 1, row + 2 * pairs);
  }
}

// A window of twice the side is four of these, `shift` windows apart; none lies outside the image.
void widen(const float* level, int wide, int high, int shift, const FrameKernels& kernels,
           float* out) {
  const auto width = 2 * static_cast<std::size_t>(wide);  // numbers a row
  const auto apart = 2 * static_cast<std::size_t>(std::min(shift, wide - 1));
  for (int j = 0; j < high; ++j) {
    const float* upper = level + static_cast<std::size_t>(j) * width;
    const float* lower = level + static_cast<std::size_t>(std::min(j + shift, high - 1)) * width;
    float* row = out + static_cast<std::size_t>(j) * width;
    kernels.widen(upper, lower, apart, width - apart, row);
    // The last ones reach the image's border: those beside them do, too.
    for (std::size_t i = width - apart; i < width; i += 2) {
      kernels.widen(upper + i, lower + i, width - 2 - i, 2, row + i);
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
  CANOPEER_CHECK(2 * level * kTop < (std::size_t{1} << 31), "the depth image is too large");
  const std::size_t pixels = depth.pixels().size();
  const std::size_t bounds_bytes = 2 * level * kTop * sizeof(float);
  const std::size_t bytes = bounds_bytes + (pixels + kCoarseBeyond) * sizeof(std::uint16_t);
  memory_ = std::move(last_memory);
  if (memory_.bytes() < bytes) memory_ = HugeMemory(bytes);
  auto* bounds = new (memory_.data()) float[2 * level * kTop];  // each is written below
  halve(depth, wide, high, kernels, bounds);
  for (int l = 1; l < kTop; ++l) {
    const std::size_t below = 2 * static_cast<std::size_t>(l - 1) * level;
    const int shift = 1 << (l - 1);  // half a window, in windows
    widen(&bounds[below], wide, high, shift, kernels, &bounds[below + 2 * level]);
  }
  flat_.width = depth.width();
  flat_.height = depth.height();
  flat_.fx = static_cast<float>(k.fx);
  flat_.fy = static_cast<float>(k.fy);
  flat_.cx = static_cast<float>(k.cx);
  flat_.cy = static_cast<float>(k.cy);
  flat_.depth = depth.pixels().data();
  flat_.bounds = bounds;
  flat_.top = kTop;
  flat_.wide = wide;
  flat_.level_size = static_cast<std::int32_t>(level);
  float least = 0.0F;  // of −depth
  for (std::size_t i = 0; i < level; ++i) least = std::min(least, bounds[2 * i + 1]);
  flat_.largest = -least;
  if (kernels.coarsen == nullptr) return;
  auto* coarse = new (memory_.data() + bounds_bytes) std::uint16_t[pixels + kCoarseBeyond];
  std::fill_n(&coarse[pixels], kCoarseBeyond, std::uint16_t{0});
  flat_.coarse_scale = 65535.0F / std::max(flat_.largest, kLeastCoarse);
  kernels.coarsen(flat_.depth, pixels, flat_.coarse_scale, coarse);
  flat_.coarse_depth = coarse;
}

DepthPyramid::~DepthPyramid() { last_memory = std::move(memory_); }

}  // namespace canopeer
