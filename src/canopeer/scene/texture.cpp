#include "canopeer/scene/texture.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

/// Pixel of `x` in 0 … 1, repeated beyond; what is not finite is the first one.
int pixel_of(float x, int size) {
  const float share = x - std::floor(x);
  if (!(share >= 0.0F)) return 0;
  return std::min(static_cast<int>(share * static_cast<float>(size)), size - 1);
}

template <typename T>
const T& nearest(const Image<T>& image, const Eigen::Vector2f& uv) {
  return image.at(pixel_of(uv.x(), image.width()),
                  image.height() - 1 - pixel_of(uv.y(), image.height()));
}

}  // namespace

Eigen::Vector3f Texture::color_at(const Eigen::Vector2f& uv) const {
  const Rgb& c = nearest(color, uv);
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

bool Texture::solid_at(const Eigen::Vector2f& uv) const {
  return opacity.empty() || nearest(opacity, uv) >= cut_below;
}

bool Texture::cuts() const {
  return std::any_of(opacity.pixels().begin(), opacity.pixels().end(),
                     [&](std::uint8_t alpha) { return alpha < cut_below; });
}

}  // namespace canopeer
