#include "canopeer/fruit/depth_tiles.h"

#include <algorithm>
#include <cmath>

#include "canopeer/fruit/four.h"

namespace canopeer {

DepthTiles::DepthTiles(const DepthImage& depth)
    : columns_((depth.width() + kSide - 1) / kSide),
      rows_((depth.height() + kSide - 1) / kSide),
      farthest_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F) {
  for (int v = 0; v < depth.height(); ++v) {
    float* const tiles = farthest_.data() + static_cast<std::ptrdiff_t>(v / kSide) * columns_;
    for (int tile = 0; tile < columns_; ++tile) {
      const int begin = tile * kSide;
      const float* const pixels = depth.pixels().data() + std::ptrdiff_t{v} * depth.width() + begin;
      const int count = std::min(kSide, depth.width() - begin);
      Four far = {tiles[tile], 0.0F, 0.0F, 0.0F};
      int i = 0;
      for (; i + 4 <= count; i += 4) {
        const Four here = load_four(pixels + i);
        far = here > far ? here : far;
      }
      for (; i < count; ++i) far[0] = std::max(far[0], pixels[i]);
      tiles[tile] = std::max(std::max(far[0], far[1]), std::max(far[2], far[3]));
    }
  }
}

float DepthTiles::farthest(double u_low, double v_low, double u_high, double v_high) const {
  const auto tile = [](double pixel, int count) {
    return static_cast<int>(std::clamp(std::floor(pixel / kSide), -1.0, double(count)));
  };
  const int left = std::max(0, tile(u_low, columns_));
  const int right = std::min(columns_ - 1, tile(u_high, columns_));
  const int top = std::max(0, tile(v_low, rows_));
  const int bottom = std::min(rows_ - 1, tile(v_high, rows_));
  float far = 0.0F;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      far = std::max(far, farthest_[static_cast<std::size_t>(y * columns_ + x)]);
    }
  }
  return far;
}

}  // namespace canopeer
