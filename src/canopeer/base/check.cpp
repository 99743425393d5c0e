#include "canopeer/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace canopeer::internal {

void check_failed(const char* file, int line, const char* condition, const char* message) {
  std::fprintf(stderr, "%s:%d: internal error: %s (%s)\n", file, line, message, condition);
  std::abort();
}

}  // namespace canopeer::internal
