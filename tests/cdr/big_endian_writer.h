#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "canopeer/cdr/cdr.h"

namespace canopeer::ros {

/// The rules of CDR once more, octet by octet and with the highest octet first.
class BigEndianWriter {
 public:
  static constexpr bool kReads = false;
  template <class... Members>
  void operator()(const Members&... members) {
    (write(members), ...);
  }
  Payload take() { return bytes_; }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      while ((bytes_.size() - 4) % sizeof(T) != 0) bytes_.push_back(0);
      std::array<std::uint8_t, sizeof(T)> octets{};
      std::memcpy(octets.data(), &value, sizeof(T));
      bytes_.insert(bytes_.end(), octets.rbegin(), octets.rend());
    } else {
      const_cast<T&>(value).visit(*this);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    for (const char letter : text) write(static_cast<std::uint8_t>(letter));
    write(std::uint8_t{0});
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    for (const auto& value : values) write(value);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    for (const T& value : values) write(value);
  }

  Payload bytes_ = {0, 0, 0, 0};
};

}  // namespace canopeer::ros
