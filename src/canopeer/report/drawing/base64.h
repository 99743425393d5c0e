#pragma once

#include <string>
#include <string_view>

namespace canopeer {

/// RFC 4648 with padding, as `data:` URLs want it.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace canopeer
