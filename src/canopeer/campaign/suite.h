#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// One world of CanopeerBench: a frozen scene and the mission on it.
struct SuiteWorld {
  std::string name;
  std::string split;       ///< train, validation or test
  std::string kind;        ///< sparse, dense or imported
  int levels = 1;          ///< heights of the lift
  std::string noise;       ///< clean, d435 or noisy
  std::uint64_t seed = 1;  ///< it was grown with; runs have seeds of their own
  int fruits_counted = 0;
  std::filesystem::path mission;
  std::string sha256;  ///< of its scene file
};

/// CanopeerBench: worlds that are stored, never grown again, so that results of different people
/// and years can be compared (docs/benchmark.md).
struct Suite {
  std::filesystem::path folder;
  std::string version;
  std::string sha256;  ///< of SHA256SUMS, and so of everything in it
  std::vector<SuiteWorld> worlds;

  /// Null: there is no such world.
  [[nodiscard]] const SuiteWorld* find(std::string_view name) const;
};

/// Reads `folder`/suite.csv, VERSION and SHA256SUMS. The error names file, line and column.
[[nodiscard]] Expected<Suite> load_suite(const std::filesystem::path& folder);

/// Whether every file is what it was: each listed in SHA256SUMS is there with that hash, and every
/// world's mission and scene are listed. The error names the first file that is not.
[[nodiscard]] Expected<void> verify_suite(const Suite& suite);

/// The worlds of a split; "all": every world. Error: no such split.
[[nodiscard]] Expected<std::vector<SuiteWorld>> worlds_of(const Suite& suite,
                                                          std::string_view split);

}  // namespace canopeer
