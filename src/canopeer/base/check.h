#pragma once

namespace canopeer::internal {

[[noreturn]] void check_failed(const char* file, int line, const char* condition,
                               const char* message);

}  // namespace canopeer::internal

/// Stops the program when an invariant of our own code is broken (a bug, never bad input). Armed in
/// every build.
#define CANOPEER_CHECK(condition, message)                                         \
  do {                                                                             \
    if (!(condition)) {                                                            \
      ::canopeer::internal::check_failed(__FILE__, __LINE__, #condition, message); \
    }                                                                              \
  } while (false)
