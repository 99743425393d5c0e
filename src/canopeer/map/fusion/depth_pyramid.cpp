#include "canopeer/map/fusion/depth_pyramid.h"

#include <algorithm>
#include <bit>
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

// Depths are not negative, so they compare as integers do, which the compiler makes vectors of.
float largest_of(const DepthImage& depth) {
  std::int32_t largest = 0;
  for (const float pixel : depth.pixels()) {
    largest = std::max(largest, std::bit_cast<std::int32_t>(pixel));
  }
  return std::bit_cast<float>(largest);
}

// Level 1: the 2 × 2 pixels of each window; an odd row or column out pairs with itself.
void halve(const std::uint16_t* depth, int width, int height, int wide, int high,
           const FrameKernels& kernels, std::uint16_t* out) {
  const auto pairs = static_cast<std::size_t>(width / 2);
  const auto row_of = [&](int v) {
    return depth + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
  };
  for (int j = 0; j < high; ++j) {
    const std::uint16_t* upper = row_of(2 * j);
    const std::uint16_t* lower = row_of(std::min(2 * j + 1, height - 1));
    std::uint16_t* row = out + 2 * static_cast<std::size_t>(j) * static_cast<std::size_t>(wide);
    kernels.halve(upper, lower, pairs, row);
    if (width % 2 == 0) continue;
    const std::uint16_t last_upper[2] = {upper[2 * pairs], upper[2 * pairs]};
    const std::uint16_t last_lower[2] = {lower[2 * pairs], lower[2 * pairs]};
    kernels.halve(last_upper, last_lower, 1, row + 2 * pairs);
  }
}

// A window of twice the side is four of these, `shift` windows apart; none lies outside the image.
void widen(const std::uint16_t* level, int wide, int high, int shift, const FrameKernels& kernels,
           std::uint16_t* out) {
  const auto width = 2 * static_cast<std::size_t>(wide);  // numbers a row
  const auto apart = 2 * static_cast<std::size_t>(std::min(shift, wide - 1));
  for (int j = 0; j < high; ++j) {
    const std::uint16_t* upper = level + static_cast<std::size_t>(j) * width;
    const std::uint16_t* lower =
        level + static_cast<std::size_t>(std::min(j + shift, high - 1)) * width;
    std::uint16_t* row = out + static_cast<std::size_t>(j) * width;
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
  const std::size_t numbers = pixels + kCoarseBeyond + 2 * level * kTop;
  memory_ = std::move(last_memory);
  if (memory_.bytes() < numbers * sizeof(std::uint16_t)) {
    memory_ = HugeMemory(numbers * sizeof(std::uint16_t));
  }
  auto* coarse = new (memory_.data()) std::uint16_t[numbers];  // each is written below
  std::uint16_t* bounds = coarse + pixels + kCoarseBeyond;
  flat_.width = depth.width();
  flat_.height = depth.height();
  flat_.fx = static_cast<float>(k.fx);
  flat_.fy = static_cast<float>(k.fy);
  flat_.cx = static_cast<float>(k.cx);
  flat_.cy = static_cast<float>(k.cy);
  flat_.depth = depth.pixels().data();
  flat_.largest = largest_of(depth);
  flat_.coarse_depth = coarse;
  flat_.coarse_scale = 65535.0F / std::max(flat_.largest, kLeastCoarse);
  flat_.bounds = bounds;
  flat_.top = kTop;
  flat_.wide = wide;
  flat_.level_size = static_cast<std::int32_t>(level);
  kernels.coarsen(flat_.depth, pixels, flat_.coarse_scale, coarse);
  std::fill_n(coarse + pixels, kCoarseBeyond, std::uint16_t{0});
  halve(coarse, depth.width(), depth.height(), wide, high, kernels, bounds);
  for (int l = 1; l < kTop; ++l) {
    const std::size_t below = 2 * static_cast<std::size_t>(l - 1) * level;
    const int shift = 1 << (l - 1);  // half a window, in windows
    widen(&bounds[below], wide, high, shift, kernels, &bounds[below + 2 * level]);
  }
}

DepthPyramid::~DepthPyramid() { last_memory = std::move(memory_); }

}  // namespace canopeer
