#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace canopeer {

/// What went wrong in the world (a file, a sensor, an option): what, where, and what to do about
/// it, in one line.
struct Error {
  std::string message;
};

/// A value, or the reason why there is none. Errors are handled exactly once: passed on or
/// reported.
template <typename T>
using Expected = tl::expected<T, Error>;

/// `return fail("...")` from a function returning any Expected<T>.
inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

/// Passes an error on with the place in front: "context: message".
inline tl::unexpected<Error> fail_in(const std::string& context, const Error& error) {
  return fail(context + ": " + error.message);
}

}  // namespace canopeer
