#pragma once

#include <cstdint>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// True when the bytes begin as a PGM file does.
[[nodiscard]] bool is_pgm(std::string_view bytes);

/// The samples of a grey image of 16 bits (the largest value stated is above 255), binary (P5, most
/// significant byte first) or text (P2). Memory stays in proportion to the file.
[[nodiscard]] Expected<Image<std::uint16_t>> parse_pgm16(std::string_view bytes);

}  // namespace canopeer
