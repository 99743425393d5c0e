#pragma once

#include <type_traits>
#include <utility>

#include "canopeer/base/expected.h"

namespace canopeer::app {

/// What the program ends with.
enum ExitStatus { kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130 };

/// Thrown to end a command; everything there is to say has been said.
struct Stop {
  ExitStatus status;
};

/// Prints "canopeer: message" on standard error and throws Stop. The one place where errors end.
[[noreturn]] void stop_with(ExitStatus status, const Error& error);

/// The value, or the end of the command.
template <typename T>
T value_or_stop(Expected<T> value, ExitStatus status) {
  if (!value) stop_with(status, value.error());
  if constexpr (!std::is_void_v<T>) return std::move(*value);
}

}  // namespace canopeer::app
