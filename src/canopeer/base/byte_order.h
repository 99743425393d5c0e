#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace canopeer {

/// How numbers lie in a file, whatever the host does.
enum class ByteOrder { little, big };

namespace internal {

/// The unsigned integer as wide as T.
template <typename T>
using BitsOf = std::conditional_t<
    sizeof(T) == 8, std::uint64_t,
    std::conditional_t<sizeof(T) == 4, std::uint32_t,
                       std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

}  // namespace internal

/// The number whose bytes begin at `bytes`.
template <typename T>
T load_number(const char* bytes, ByteOrder order = ByteOrder::little) {
  static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 8);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t at = order == ByteOrder::little ? sizeof(T) - 1 - i : i;
    bits = bits << 8 | static_cast<unsigned char>(bytes[at]);
  }
  const auto narrow = static_cast<internal::BitsOf<T>>(bits);
  T value;
  std::memcpy(&value, &narrow, sizeof value);
  return value;
}

/// Appends a number, least significant byte first.
template <typename T>
void append_number(std::string& bytes, T value) {
  static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 8);
  internal::BitsOf<T> bits;
  std::memcpy(&bits, &value, sizeof bits);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes.push_back(static_cast<char>(static_cast<std::uint64_t>(bits) >> (8 * i) & 0xFFU));
  }
}

}  // namespace canopeer
