#include "canopeer/base/percent_encoding.h"

#include <charconv>

namespace canopeer {

std::string percent_decoded(std::string_view address) {
  std::string plain;
  for (std::size_t i = 0; i < address.size(); ++i) {
    unsigned char character = 0;
    if (address[i] == '%' && i + 2 < address.size()) {
      const char* const end = address.data() + i + 3;
      const auto read = std::from_chars(end - 2, end, character, 16);
      if (read.ec == std::errc() && read.ptr == end) {
        plain += static_cast<char>(character);
        i += 2;
        continue;
      }
    }
    plain += address[i];
  }
  return plain;
}

}  // namespace canopeer
