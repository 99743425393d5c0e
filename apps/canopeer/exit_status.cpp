#include "exit_status.h"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace canopeer::app {

void stop_with(ExitStatus status, const Error& error) {
  std::fprintf(stderr, "canopeer: %s\n", error.message.c_str());
  throw CLI::RuntimeError(status);
}

}  // namespace canopeer::app
