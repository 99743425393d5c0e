#include "canopeer/sensing/files/lzf.h"

namespace canopeer {

// A control byte below 32: that many bytes plus one follow as they are. Else its upper three bits
// are a length (7: the next byte is added), its lower five and one more byte a distance back.
std::optional<std::string> lzf_decompress(std::string_view data, std::size_t size) {
  constexpr std::size_t kMaxRatio = 88;  // 264 bytes from three
  if (size / kMaxRatio > data.size()) return std::nullopt;
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto next = [&]() -> std::size_t { return static_cast<unsigned char>(data[at++]); };
  while (at < data.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > data.size() - at || length > size - out.size()) return std::nullopt;
      out.append(data.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at == data.size()) return std::nullopt;
      length += next();
    }
    length += 2;
    if (at == data.size()) return std::nullopt;
    const std::size_t distance = ((control & 31) << 8 | next()) + 1;
    if (distance > out.size() || length > size - out.size()) return std::nullopt;
    for (std::size_t from = out.size() - distance; length > 0; --length) {
      out.push_back(out[from++]);  // may read what it has just written
    }
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace canopeer
