#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "canopeer/base/expected.h"

namespace canopeer {

/// The value; a program that cannot go on without it says what is wrong and ends with status 2.
template <typename T>
T must(Expected<T> value) {
  if (value) return std::move(*value);
  std::fprintf(stderr, "%s\n", value.error().message.c_str());
  std::exit(2);
}

}  // namespace canopeer
