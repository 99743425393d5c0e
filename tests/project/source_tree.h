#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace canopeer::testing_support {

/// One `#include` line of a file.
struct IncludeLine {
  std::filesystem::path file;  ///< absolute
  int line = 0;
  std::string header;   ///< between the quotes or brackets
  bool quoted = false;  ///< "…", not <…>

  [[nodiscard]] std::string where() const;  ///< "src/canopeer/map/fusion.cpp:12", from the root
};

/// The repository this test was built from.
[[nodiscard]] std::filesystem::path source_root();

/// All .h and .cpp files under `root`/`dir`, sorted; none when the directory is not there.
[[nodiscard]] std::vector<std::filesystem::path> source_files(const std::string& dir);

[[nodiscard]] std::vector<IncludeLine> includes_under(const std::string& dir);

/// Lines of a text file; fails the test when it cannot be read.
[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& path);

}  // namespace canopeer::testing_support
