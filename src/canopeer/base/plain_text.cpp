#include "canopeer/base/plain_text.h"

#include <algorithm>
#include <cstdint>

namespace canopeer {
namespace {

void append_utf8(std::string& text, std::uint32_t code) {
  const auto byte = [&](std::uint32_t value) { text.push_back(static_cast<char>(value)); };
  const auto tail = [&](int shift) { byte(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0U | code >> 6);
    tail(0);
  } else if (code < 0x10000) {
    byte(0xE0U | code >> 12);
    tail(6);
    tail(0);
  } else {
    byte(0xF0U | code >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

/// `bytes` without the mark. A lone half of a pair becomes the replacement character.
std::string from_utf16(std::string_view bytes, bool big_endian) {
  const auto unit = [&](std::size_t at) -> std::uint32_t {
    const auto first = static_cast<unsigned char>(bytes[at]);
    const auto second = static_cast<unsigned char>(bytes[at + 1]);
    return big_endian ? first << 8U | second : second << 8U | first;
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    const bool pair = code >= 0xD800 && code < 0xDC00 && at + 3 < bytes.size() &&
                      unit(at + 2) >= 0xDC00 && unit(at + 2) < 0xE000;
    if (pair) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(at + 2) - 0xDC00);
      at += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = 0xFFFD;
    }
    append_utf8(text, code);
  }
  return text;
}

}  // namespace

PlainText::PlainText(std::string_view bytes) : view_(bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) view_.remove_prefix(3);
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    converted_ = from_utf16(bytes.substr(2), bytes[0] == '\xFE');
    view_ = converted_;
  }
  // Some programs end lines with \r alone.
  if (view_.find('\n') == std::string_view::npos && view_.find('\r') != std::string_view::npos) {
    if (converted_.empty()) converted_ = view_;
    std::replace(converted_.begin(), converted_.end(), '\r', '\n');
    view_ = converted_;
  }
}

}  // namespace canopeer
