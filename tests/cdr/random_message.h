#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "canopeer/base/rng.h"

namespace canopeer::ros {

/// Fills a message with random values: texts and sequences of 0 … 3 elements.
class RandomFill {
 public:
  static constexpr bool kReads = true;  // what is never read stays empty
  explicit RandomFill(Rng& rng) : rng_(rng) {}
  template <class... Members>
  void operator()(Members&... members) {
    (fill(members), ...);
  }

 private:
  template <class T>
  void fill(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = rng_.chance(0.5);
    } else if constexpr (std::is_floating_point_v<T>) {
      value = static_cast<T>(rng_.normal(0.0, 100.0));
    } else if constexpr (std::is_integral_v<T>) {
      value = static_cast<T>(rng_.bits());
    } else {
      value.visit(*this);
    }
  }
  void fill(std::string& text) {
    text.resize(rng_.index(4));
    for (char& letter : text) letter = static_cast<char>('a' + rng_.index(26));
  }
  void fill(std::vector<bool>& values) {
    values.resize(rng_.index(4));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = rng_.chance(0.5);
  }
  template <class T>
  void fill(std::vector<T>& values) {
    values.resize(rng_.index(4));
    for (T& value : values) fill(value);
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& values) {
    for (T& value : values) fill(value);
  }

  Rng& rng_;
};

template <class Message>
Message random_message(Rng& rng) {
  Message message;
  RandomFill fill(rng);
  fill(message);
  return message;
}

}  // namespace canopeer::ros
