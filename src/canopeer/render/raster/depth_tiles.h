#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace canopeer {

/// Pixels first … last, both included.
struct PixelBox {
  int first_column = 0, last_column = 0;
  int first_row = 0, last_row = 0;
};

/// What a view shows so far. Each pixel has the nearness (1 / depth, 1/m) of the nearest surface,
/// and which one it is. Each tile of 8 × 8 pixels has how near all of it is at least, so what is
/// behind need not be drawn. Different threads may work on rows of tiles.
class DepthTiles {
 public:
  static constexpr int kTile = 8;  // pixels a side

  DepthTiles(int width, int height);

  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] float* nearness() { return nearness_.data(); }
  [[nodiscard]] std::uint32_t* surface() { return surface_.data(); }
  [[nodiscard]] const std::uint32_t* surface_row(int v) const {
    return surface_.data() + static_cast<std::size_t>(v) * stride_;
  }

  [[nodiscard]] const float* nearness_row(int v) const {
    return nearness_.data() + static_cast<std::size_t>(v) * stride_;
  }

  /// Whether something nearer than `nearness` is seen all over the box.
  [[nodiscard]] bool hidden(const PixelBox& box, float nearness);
  /// Pixels of the box may have become nearer.
  void drawn(const PixelBox& box);
  /// Pixels that show nothing so far will show nothing.
  void close_empty();

 private:
  void refresh(std::size_t tile);

  std::size_t tiles_across_ = 0;
  std::size_t stride_ = 0;
  std::vector<float> nearness_;
  std::vector<std::uint32_t> surface_;
  std::vector<float> tile_least_;    // may lag behind: too far is never wrong
  std::vector<std::uint8_t> stale_;  // per tile
};

}  // namespace canopeer
