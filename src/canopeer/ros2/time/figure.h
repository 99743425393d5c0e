#pragma once

#include <array>
#include <charconv>
#include <string>

namespace canopeer::ros {

/// A number for people: 1.5 is "1.50" with two decimals.
[[nodiscard]] inline std::string figure(double value, int decimals = 2) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return end.ec == std::errc() ? std::string(text.data(), end.ptr) : std::string("?");
}

}  // namespace canopeer::ros
