#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/meshes/picture_kind.h"

namespace canopeer {

/// More pixels than this are a broken header, which must not eat all memory.
inline constexpr std::size_t kMostPicturePixels = 128U << 20;

/// A picture row by row from the top, four bytes a pixel: red, green, blue, opacity.
struct PlainPicture {
  int width = 0;
  int height = 0;
  bool alpha = false;  ///< the picture says something about opacity
  std::vector<std::uint8_t> rgba;
};

/// Reads TGA, BMP, GIF (its first picture), PSD (all layers as saved) and WebP. The libraries work
/// in a child process with limits (guarded_call.h), since a damaged file may bring them down.
/// Error: what is wrong with the picture, to follow its name; one that is cut off is wrong.
[[nodiscard]] Expected<PlainPicture> read_picture(PictureKind kind, std::string_view bytes);

}  // namespace canopeer
