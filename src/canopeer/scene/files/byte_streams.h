#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "canopeer/base/byte_order.h"

namespace canopeer {

/// Small numbers in few bytes: seven bits a byte, the lowest first, the eighth says that more
/// follow.
inline void append_varint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) bytes.push_back(static_cast<char>(value | 0x80U));
  bytes.push_back(static_cast<char>(value));
}

/// The same for numbers of either sign: 0, −1, 1, −2 … become 0, 1, 2, 3 …
inline void append_signed(std::string& bytes, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  append_varint(bytes, value < 0 ? ~(bits << 1U) : bits << 1U);
}

inline void append_text(std::string& bytes, std::string_view text) {
  append_varint(bytes, text.size());
  bytes += text;
}

/// Takes values off the front of bytes. Past their end, or after a number that is none, everything
/// taken is zero or empty, and ok() is false from then on.
class ByteTaker {
 public:
  explicit ByteTaker(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) return failed();
    const std::string_view taken = bytes_.substr(0, static_cast<std::size_t>(size));
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  template <typename T>
  T number() {
    const std::string_view bytes = take(sizeof(T));
    return ok_ ? load_number<T>(bytes.data()) : T{};
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = number<std::uint8_t>();
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80U) return value;
    }
    failed();
    return 0;
  }
  std::int64_t signed_varint() {
    const std::uint64_t bits = varint();
    return static_cast<std::int64_t>((bits & 1U) != 0 ? ~(bits >> 1U) : bits >> 1U);
  }
  /// A varint of at most `most`.
  std::uint64_t bounded(std::uint64_t most) {
    const std::uint64_t value = varint();
    if (value <= most) return value;
    failed();
    return 0;
  }
  std::string_view text() { return take(varint()); }

 private:
  std::string_view failed() {
    ok_ = false;
    bytes_ = {};
    return {};
  }

  std::string_view bytes_;
  bool ok_ = true;
};

}  // namespace canopeer
