#include "exit_status.h"

#include <cstdio>

namespace canopeer::app {

void stop_with(ExitStatus status, const Error& error) {
  std::fflush(stdout);
  std::fprintf(stderr, "canopeer: %s\n", error.message.c_str());
  throw Stop{status};
}

}  // namespace canopeer::app
