#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "canopeer/base/expected.h"

// Plain CDR (OMG DDS-XTypes 1.3, 7.4: XCDR version 1, final types): the bytes of ROS 2 messages on
// DDS topics, in MCAP files and in rosbag2 databases. A message names its members in order:
//
//     struct Point { double x{}, y{}, z{};
//                    template <class Archive> void visit(Archive& a) { a(x, y, z); } };

namespace canopeer::ros {

/// One message as bytes, the encapsulation header included.
using Payload = std::vector<std::uint8_t>;

/// Writes little endian.
class CdrWriter {
 public:
  static constexpr bool kReads = false;
  template <class... Members>
  void operator()(const Members&... members) {
    (write(members), ...);
  }
  [[nodiscard]] Payload take() { return std::move(bytes_); }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      bytes_.push_back(value ? 1 : 0);
    } else if constexpr (std::is_arithmetic_v<T>) {
      align(sizeof(T));
      append(&value, sizeof(T));
    } else {
      const_cast<T&>(value).visit(*this);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    append(text.c_str(), text.size() + 1);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    write_elements(values);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    write_elements(values);
  }
  template <class Values>
  void write_elements(const Values& values) {
    using T = typename Values::value_type;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (values.empty()) return;  // no padding for nothing
      align(sizeof(T));
      append(values.data(), values.size() * sizeof(T));
    } else {
      for (const auto& value : values) write(value);
    }
  }
  /// Counted from behind the header.
  void align(std::size_t size) {
    while ((bytes_.size() - 4) % size != 0) bytes_.push_back(0);
  }
  void append(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  static_assert(std::endian::native == std::endian::little);
  Payload bytes_ = {0, 1, 0, 0};  // CDR, little endian, no options
};

/// Reads either byte order. Takes any bytes: throws std::runtime_error when they are no such
/// message, before it allocates more than the payload could hold (an empty text of 4 octets takes
/// 32 of memory; nothing takes more than 16 times its payload). What comes after the message is
/// left alone: some writers send a few octets too many.
class CdrReader {
 public:
  static constexpr bool kReads = true;
  explicit CdrReader(std::span<const std::uint8_t> payload) : bytes_(payload) {
    if (bytes_.size() < 4 || bytes_[0] != 0 || bytes_[1] > 1) {
      throw std::runtime_error("not plain CDR");
    }
    swap_ = bytes_[1] == 0;
  }
  template <class... Members>
  void operator()(Members&... members) {
    (read(members), ...);
  }
  /// Octets not read yet.
  [[nodiscard]] std::size_t left() const { return at_ < bytes_.size() ? bytes_.size() - at_ : 0; }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t octet = 0;
      read(octet);
      value = octet != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      align(sizeof(T));
      copy(&value, sizeof(T));
      if (swap_) flip(value);
    } else {
      value.visit(*this);
    }
  }
  void read(std::string& text) {
    std::uint32_t size = 0;
    read(size);
    need(size);
    const auto* begin = reinterpret_cast<const char*>(bytes_.data() + at_);
    text.assign(begin, size == 0 ? 0 : size - 1);
    at_ += size;
  }
  template <class T>
  void read(std::vector<T>& values) {
    std::uint32_t count = 0;
    read(count);
    values.clear();
    if (count == 0) return;
    if constexpr (std::is_arithmetic_v<T>) {
      align(sizeof(T));
      need(std::size_t{count} * sizeof(T));
      values.resize(count);
      copy(values.data(), count * sizeof(T));
      if (swap_) {
        for (T& value : values) flip(value);
      }
    } else {
      need(count);  // each has one octet at least
      for (std::uint32_t i = 0; i < count; ++i) read(values.emplace_back());
    }
  }
  void read(std::vector<bool>& values) {
    std::uint32_t count = 0;
    read(count);
    need(count);
    values.assign(count, false);
    for (std::uint32_t i = 0; i < count; ++i) values[i] = bytes_[at_++] != 0;
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  void align(std::size_t size) { at_ += (size - (at_ - 4) % size) % size; }
  void need(std::size_t size) const {
    if (at_ > bytes_.size() || size > bytes_.size() - at_) throw std::runtime_error("cut short");
  }
  void copy(void* to, std::size_t size) {
    need(size);
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  template <class T>
  static void flip(T& value) {
    auto* octets = reinterpret_cast<unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(octets[i], octets[sizeof(T) - 1 - i]);
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 4;
  bool swap_ = false;
};

template <class Message>
[[nodiscard]] Payload to_cdr(const Message& message) {
  CdrWriter writer;
  writer(message);
  return writer.take();
}

/// The error says why the bytes are no such message.
template <class Message>
[[nodiscard]] Expected<Message> from_cdr(std::span<const std::uint8_t> payload) {
  try {
    CdrReader reader(payload);
    Message message;
    reader(message);
    return message;
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

}  // namespace canopeer::ros
