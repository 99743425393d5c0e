#include "canopeer/render/raster/depth_tiles.h"

#include <algorithm>
#include <array>
#include <limits>

#include "canopeer/render/raster/raster_kernels.h"
#include "canopeer/render/raster/visible_surface.h"

namespace canopeer {
namespace {

std::size_t tiles_of(int pixels) {
  return static_cast<std::size_t>((pixels + DepthTiles::kTile - 1) / DepthTiles::kTile);
}

}  // namespace

DepthTiles::DepthTiles(int width, int height)
    : tiles_across_(tiles_of(width)),
      stride_(tiles_across_ * kTile + kRasterLanes),
      nearness_(stride_ * tiles_of(height) * kTile, 0.0F),
      surface_(nearness_.size(), kNoSurface),
      tile_least_(tiles_across_ * tiles_of(height), 0.0F),
      stale_(tile_least_.size(), 0) {
  // What is outside the picture hides nothing from view.
  constexpr float kNearest = std::numeric_limits<float>::infinity();
  for (auto row = nearness_.begin(); row != nearness_.end(); row += stride_) {
    std::fill(row + width, row + stride_, kNearest);
  }
  std::fill(nearness_.begin() + static_cast<std::ptrdiff_t>(stride_) * height, nearness_.end(),
            kNearest);
}

void DepthTiles::refresh(std::size_t tile) {
  const float* row =
      nearness_.data() + tile / tiles_across_ * kTile * stride_ + tile % tiles_across_ * kTile;
  std::array<float, kTile> least;
  std::copy_n(row, kTile, least.begin());
  for (int v = 1; v < kTile; ++v) {
    row += stride_;
    for (std::size_t u = 0; u < kTile; ++u) least[u] = row[u] < least[u] ? row[u] : least[u];
  }
  tile_least_[tile] = *std::min_element(least.begin(), least.end());
  stale_[tile] = 0;
}

bool DepthTiles::hidden(const PixelBox& box, float nearness) {
  for (int j = box.first_row / kTile; j <= box.last_row / kTile; ++j) {
    for (int i = box.first_column / kTile; i <= box.last_column / kTile; ++i) {
      const auto tile = static_cast<std::size_t>(j) * tiles_across_ + static_cast<std::size_t>(i);
      if (tile_least_[tile] > nearness) continue;
      if (stale_[tile] == 0) return false;
      refresh(tile);
      if (tile_least_[tile] <= nearness) return false;
    }
  }
  return true;
}

void DepthTiles::drawn(const PixelBox& box) {
  for (int j = box.first_row / kTile; j <= box.last_row / kTile; ++j) {
    const auto row = stale_.begin() + j * static_cast<std::ptrdiff_t>(tiles_across_);
    std::fill(row + box.first_column / kTile, row + box.last_column / kTile + 1, std::uint8_t{1});
  }
}

void DepthTiles::close_empty() {
  for (float& nearness : nearness_) {
    if (nearness == 0.0F) nearness = std::numeric_limits<float>::infinity();
  }
  std::fill(stale_.begin(), stale_.end(), std::uint8_t{1});
}

}  // namespace canopeer
