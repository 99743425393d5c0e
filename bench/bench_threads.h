#pragma once

#include <tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace canopeer {

/// One thread, unless a benchmark takes more for itself.
class Threads {
 public:
  explicit Threads(std::size_t count) { limit().emplace(kParallelism, count); }
  ~Threads() { limit().emplace(kParallelism, 1); }

 private:
  static constexpr auto kParallelism = tbb::global_control::max_allowed_parallelism;
  static std::optional<tbb::global_control>& limit() {
    static std::optional<tbb::global_control> value;
    return value;
  }
};

}  // namespace canopeer
