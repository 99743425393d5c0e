#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "canopeer/base/expected.h"

namespace canopeer {

/// What a guarded call may use.
struct CallLimits {
  double cpu_s = 30.0;                    ///< processor time, > 0; rounded up to whole seconds
  std::size_t memory_bytes = 4UL << 30U;  ///< beyond what the process has already
};

/// Runs `call` in a child process and returns the bytes it returned. For libraries that end the
/// process, hang or take all memory over a damaged file. Error: an exception's text, or how the
/// child ended ("its reader took more than 30 s …"), to follow a file's name.
///
/// The child has one thread, a copy of the caller's. `call` must need no lock that another thread
/// may hold (malloc's is fine). It prints nothing, and what it changes is lost. Deterministic when
/// `call` is. Processor time counts, so a busy machine changes nothing; a child that sleeps is
/// ended after ten times as long. Under a sanitizer there is no limit on memory.
[[nodiscard]] Expected<std::string> guarded_call(const std::function<std::string()>& call,
                                                 const CallLimits& limits);

}  // namespace canopeer
