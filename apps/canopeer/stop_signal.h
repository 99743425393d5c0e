#pragma once

#include <atomic>

namespace canopeer::app {

/// Set by the first Ctrl-C (SIGINT) or SIGTERM: finish what is under way, write the results, end. A
/// second one ends the program at once.
std::atomic<bool>& catch_stop_signals();

}  // namespace canopeer::app
