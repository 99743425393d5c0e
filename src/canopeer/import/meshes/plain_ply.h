#pragma once

#include <string>
#include <string_view>

namespace canopeer {

/// A binary PLY file whose first byte of data is an end of line, with an element more before it:
/// the library takes every end of line after the header for one of the header's. Empty: the file
/// may be read as it is.
[[nodiscard]] std::string plain_ply(std::string_view bytes);

}  // namespace canopeer
