#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What of a JPEG is taken.
struct JpegLimits {
  std::size_t most_pixels = std::size_t{1} << 26;  ///< refused before any memory is taken
  bool whole = true;  ///< one that was cut off is refused; else what is missing is grey
};

/// The picture in the bytes of a file, grey ones as RGB. Takes any bytes; the error says what is
/// wrong with them.
[[nodiscard]] Expected<ColorImage> parse_jpeg(std::string_view bytes,
                                              const JpegLimits& limits = {});

/// As the bytes of a file, `quality` 1 … 100; empty for an image without pixels.
[[nodiscard]] std::string encode_jpeg(const ColorImage& image, int quality);

}  // namespace canopeer
