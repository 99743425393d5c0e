#pragma once

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

#include "canopeer/base/expected.h"

namespace canopeer {

/// The value; a program that cannot go on without it says what is wrong and ends with status 2.
template <typename T>
T must(Expected<T> value) {
  if (!value) {
    std::fprintf(stderr, "%s\n", value.error().message.c_str());
    std::exit(2);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*value);
}

}  // namespace canopeer
