#pragma once

#include <array>
#include <charconv>
#include <string>

namespace canopeer {

/// The shortest text that reads back as `value`: two numbers that differ look different in a
/// message, and 0.1 stays 0.1.
[[nodiscard]] inline std::string exact_text(double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

}  // namespace canopeer
