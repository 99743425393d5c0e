#include "canopeer/map/depth_pyramid.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

DepthPyramid::Range hull(const DepthPyramid::Range& a, const DepthPyramid::Range& b) {
  return {std::min(a.min, b.min), std::max(a.max, b.max)};
}

}  // namespace

DepthPyramid::DepthPyramid(const DepthImage& depth) {
  CANOPEER_CHECK(!depth.empty(), "a depth pyramid needs an image");
  Image<Range> base(depth.width(), depth.height());
  std::transform(depth.pixels().begin(), depth.pixels().end(), base.pixels().begin(), [](float d) {
    return Range{d, d};
  });
  levels_.push_back(std::move(base));
  while (levels_.back().width() > 1 || levels_.back().height() > 1) {
    const Image<Range>& below = levels_.back();
    Image<Range> level((below.width() + 1) / 2, (below.height() + 1) / 2);
    for (int v = 0; v < level.height(); ++v) {
      const int v_next = std::min(2 * v + 1, below.height() - 1);
      for (int u = 0; u < level.width(); ++u) {
        const int u_next = std::min(2 * u + 1, below.width() - 1);
        level.at(u, v) = hull(hull(below.at(2 * u, 2 * v), below.at(u_next, 2 * v)),
                              hull(below.at(2 * u, v_next), below.at(u_next, v_next)));
      }
    }
    levels_.push_back(std::move(level));
  }
}

DepthPyramid::Range DepthPyramid::range(int u0, int v0, int u1, int v1) const {
  // Fine enough that the cells jut out little, coarse enough that they are at most 5 × 5.
  constexpr int kCells = 4;
  std::size_t level = 0;
  while (std::max(u1 - u0, v1 - v0) >> level >= kCells && level + 1 < levels_.size()) ++level;
  const Image<Range>& cells = levels_[level];
  Range range = cells.at(u0 >> level, v0 >> level);
  for (int v = v0 >> level; v <= v1 >> level; ++v) {
    for (int u = u0 >> level; u <= u1 >> level; ++u) range = hull(range, cells.at(u, v));
  }
  return range;
}

}  // namespace canopeer
