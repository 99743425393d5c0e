#include "canopeer/map/depth_pyramid.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

struct Level {
  int width, height;
  std::size_t offset;
};

std::vector<Level> levels_of(int width, int height) {
  std::vector<Level> levels = {{width, height, 0}};  // the image; it is not among the cells
  std::size_t cells = 0;
  do {
    const Level below = levels.back();
    const Level level = {(below.width + 1) / 2, (below.height + 1) / 2, cells};
    cells += static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    levels.push_back(level);
  } while (levels.back().width > 1 || levels.back().height > 1);
  return levels;
}

using Halve = void (*)(const float*, const float*, std::size_t, float*);

// One row of cells from two of the level below; `width` of those, an odd one out pairs with itself.
void halve_rows(Halve halve, const float* upper, const float* lower, int width, float* out) {
  const auto pairs = static_cast<std::size_t>(width / 2);
  halve(upper, lower, pairs, out);
  if (width % 2 == 0) return;
  const float last_upper[2] = {upper[width - 1], upper[width - 1]};
  const float last_lower[2] = {lower[width - 1], lower[width - 1]};
  halve(last_upper, last_lower, 1, out + pairs);
}

}  // namespace

DepthPyramid::DepthPyramid(const DepthImage& depth, const CameraIntrinsics& k,
                           const FrameKernels& kernels) {
  CANOPEER_CHECK(!depth.empty(), "a depth pyramid needs an image");
  const std::vector<Level> levels = levels_of(depth.width(), depth.height());
  CANOPEER_CHECK(levels.size() <= FlatPyramid::kMaxLevels,
                 "an image of at most 2^15 pixels a side");
  const Level& last = levels.back();
  min_.resize(last.offset + 1);
  max_.resize(last.offset + 1);
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const Level& below = levels[l - 1];
    const Level& level = levels[l];
    const float* below_min = l == 1 ? depth.pixels().data() : &min_[below.offset];
    const float* below_max = l == 1 ? depth.pixels().data() : &max_[below.offset];
    const auto stride = static_cast<std::size_t>(below.width);
    for (int v = 0; v < level.height; ++v) {
      const auto upper = static_cast<std::size_t>(2 * v) * stride;
      const auto lower = static_cast<std::size_t>(std::min(2 * v + 1, below.height - 1)) * stride;
      const std::size_t out =
          level.offset + static_cast<std::size_t>(v) * static_cast<std::size_t>(level.width);
      halve_rows(kernels.halve_min, below_min + upper, below_min + lower, below.width, &min_[out]);
      halve_rows(kernels.halve_max, below_max + upper, below_max + lower, below.width, &max_[out]);
    }
    flat_.offset[l] = static_cast<std::int32_t>(level.offset);
    flat_.cells_wide[l] = level.width;
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
  flat_.top = static_cast<int>(levels.size()) - 1;
  flat_.largest = max_.back();
}

}  // namespace canopeer
