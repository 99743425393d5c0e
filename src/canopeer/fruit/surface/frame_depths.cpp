#include "canopeer/fruit/surface/frame_depths.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/simd_vectors.h"
namespace canopeer {
namespace {

using Lanes = EightFloats;
constexpr int kLanes = 8;

/// A row of pixels and those above and below, all `width` long.
struct Row {
  const float* here;
  const float* up;
  const float* down;
  int width;
};

/// Between the first and the last pixel of a row: whether one beside is farther or nearer by a
/// step. `marked` begins with the row's first pixel. Also keeps the largest depth of each column.
[[gnu::always_inline]] inline void mark_row(const Row& row, float max_range, float max_step,
                                            float* marked, float* farthest) {
  const auto is_step = [&](const Lanes& near, const Lanes& z) -> EightBits {
    const Lanes rise = near - z;
    return (near > 0.0F) & ((rise > max_step) | (rise < -max_step));
  };
  int u = 1;
  for (; u + kLanes + 1 <= row.width; u += kLanes) {
    const auto z = load_lanes<Lanes>(row.here + u);
    const EightBits edge = (z > max_range) | is_step(load_lanes<Lanes>(row.here + u - 1), z) |
                           is_step(load_lanes<Lanes>(row.here + u + 1), z) |
                           is_step(load_lanes<Lanes>(row.up + u), z) |
                           is_step(load_lanes<Lanes>(row.down + u), z);
    store_lanes(edge ? -z : z, marked + u);
    const auto far = load_lanes<Lanes>(farthest + u);
    store_lanes(z > far ? z : far, farthest + u);
  }
  for (; u + 1 < row.width; ++u) {
    const float z = row.here[u];
    const auto step = [&](float near) {
      return near > 0.0F && (near - z > max_step || near - z < -max_step);
    };
    const bool edge = z > max_range || step(row.here[u - 1]) || step(row.here[u + 1]) ||
                      step(row.up[u]) || step(row.down[u]);
    marked[u] = edge ? -z : z;
    farthest[u] = std::max(farthest[u], z);
  }
  for (const int rim : {0, row.width - 1}) {
    marked[rim] = -row.here[rim];
    farthest[rim] = std::max(farthest[rim], row.here[rim]);
  }
}

CANOPEER_WIDE void mark_row_wide(const Row& row, float max_range, float max_step, float* marked,
                                 float* farthest) {
  mark_row(row, max_range, max_step, marked, farthest);
}

void mark_row_narrow(const Row& row, float max_range, float max_step, float* marked,
                     float* farthest) {
  mark_row(row, max_range, max_step, marked, farthest);
}

}  // namespace

void FrameDepths::set(const DepthImage& depth, float max_range_m, float max_step_m,
                      SimdLevel level) {
  const int width = depth.width();
  const int height = depth.height();
  if (width != width_ || height != height_) {
    width_ = width;
    height_ = height;
    tile_columns_ = (width + kTile - 1) / kTile;
    tile_rows_ = (height + kTile - 1) / kTile;
    marked_.assign(static_cast<std::size_t>(stride() * (height + 2)), 0.0F);
    farthest_.resize(static_cast<std::size_t>(tile_columns_) *
                     static_cast<std::size_t>(tile_rows_));
    farthest_row_.resize(static_cast<std::size_t>(tile_columns_) * kTile);
  }
  const auto mark = level >= SimdLevel::avx2 ? mark_row_wide : mark_row_narrow;
  const float* const pixels = depth.pixels().data();
  for (int v = 0; v < height; ++v) {
    if (v % kTile == 0) std::fill(farthest_row_.begin(), farthest_row_.end(), 0.0F);
    const float* const here = pixels + std::ptrdiff_t{v} * width;
    const bool rim = v == 0 || v + 1 == height;
    float* const out = marked_.data() + (v + 1) * stride() + 1;
    mark({here, v > 0 ? here - width : here, v + 1 < height ? here + width : here, width},
         max_range_m, max_step_m, out, farthest_row_.data());
    for (int u = 0; rim && u < width; ++u) out[u] = -here[u];
    if ((v + 1) % kTile != 0 && v + 1 < height) continue;
    float* const tiles = farthest_.data() + std::ptrdiff_t{v / kTile} * tile_columns_;
    for (int tile = 0; tile < tile_columns_; ++tile) {
      const float* const columns = farthest_row_.data() + std::ptrdiff_t{tile} * kTile;
      tiles[tile] = *std::max_element(columns, columns + kTile);
    }
  }
}

float FrameDepths::farthest(double u_low, double v_low, double u_high, double v_high) const {
  const auto tile = [](double pixel, int count) {
    return static_cast<int>(std::clamp(std::floor(pixel / kTile), -1.0, double(count)));
  };
  const int left = std::max(0, tile(u_low, tile_columns_));
  const int right = std::min(tile_columns_ - 1, tile(u_high, tile_columns_));
  const int top = std::max(0, tile(v_low, tile_rows_));
  const int bottom = std::min(tile_rows_ - 1, tile(v_high, tile_rows_));
  float far = 0.0F;
  for (int y = top; y <= bottom; ++y) {
    const float* const tiles = farthest_.data() + std::ptrdiff_t{y} * tile_columns_;
    for (int x = left; x <= right; ++x) far = std::max(far, tiles[x]);
  }
  return far;
}

}  // namespace canopeer
