#pragma once

#include <cstdint>
#include <span>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"

namespace canopeer::ros {

/// Any bytes may come. The error: no JPEG, damaged, cut off, or too big.
[[nodiscard]] Expected<ColorImage> decode_jpeg_image(std::span<const std::uint8_t> bytes);

}  // namespace canopeer::ros
