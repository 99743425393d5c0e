#pragma once

#include <cstdint>
#include <filesystem>

namespace canopeer::testing_support {

struct SyntheticRunOptions {
  int segments = 8;
  bool truth = true;
  bool interrupted = false;
  bool fruits = true;
  bool on_the_way = false;  ///< frames between views, by a clock that never stops
  std::uint64_t seed = 1;
};

/// Fills `run_dir` with what a run over two plant rows could have left there: plausible, not
/// measured.
void write_synthetic_run(const std::filesystem::path& run_dir, const SyntheticRunOptions& options);

}  // namespace canopeer::testing_support
