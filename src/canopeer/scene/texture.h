#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "canopeer/sensing/image.h"

namespace canopeer {

/// A picture that colours a surface and may cut holes into it. Texture coordinates: u right, v up,
/// (0, 0) at the lower left corner of the picture; beyond 0 … 1 it repeats.
struct Texture {
  std::string name;             ///< file it came from, for messages
  ColorImage color;             ///< may be empty: only the opacity matters
  Image<std::uint8_t> opacity;  ///< empty: opaque everywhere; its size may differ from the colour's
  std::uint8_t cut_below = 128;  ///< less opacity than this is a hole

  /// Colour of the nearest pixel; grey levels 0 … 255. The colour image must not be empty.
  [[nodiscard]] Eigen::Vector3f color_at(const Eigen::Vector2f& uv) const;
  /// Whether the surface is there.
  [[nodiscard]] bool solid_at(const Eigen::Vector2f& uv) const;
  /// Whether any pixel is a hole.
  [[nodiscard]] bool cuts() const;
};

}  // namespace canopeer
