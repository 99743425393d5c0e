#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace canopeer::test {

/// How a run of the program ended, and what it printed.
struct ProgramResult {
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs `canopeer ARGUMENTS…` from the source directory and waits.

ProgramResult canopeer(const std::vector<std::string>& arguments);

/// The same, but SIGINT is sent as soon as `file` exists.
ProgramResult canopeer_interrupted(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& file);

/// The same, but SIGINT is sent as soon as it has written to standard error.
ProgramResult canopeer_interrupted_when_it_speaks(const std::vector<std::string>& arguments);

/// A fresh directory of this test's own, removed at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace canopeer::test
