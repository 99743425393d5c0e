#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace canopeer {

/// A colour, 8 bit a channel.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  friend bool operator==(const Rgb& a, const Rgb& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
  }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(r, g, b);
  }
};

/// Row-major pixels; (0, 0) is the upper left one, u runs right, v down.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T fill = T{})
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  T& at(int u, int v) { return pixels_[index(u, v)]; }
  const T& at(int u, int v) const { return pixels_[index(u, v)]; }
  std::vector<T>& pixels() { return pixels_; }
  const std::vector<T>& pixels() const { return pixels_; }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }
  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

/// Distance along the optical axis in metres; 0 or NaN: no return.
using DepthImage = Image<float>;
using ColorImage = Image<Rgb>;
/// Non-zero: the pixel is in. (Not bool: std::vector<bool> is no array.)
using Mask = Image<std::uint8_t>;

}  // namespace canopeer
