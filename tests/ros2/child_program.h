#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace canopeer::testing_support {

/// `canopeer ARGUMENTS…` as a process beside this one, from the source directory. Killed when it
/// goes out of scope.
class ChildProgram {
 public:
  explicit ChildProgram(const std::vector<std::string>& arguments);
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  void send(int signal) const;
  /// Waits for its end; the exit status, or minus the signal.
  int wait();
  [[nodiscard]] bool runs();
  /// What it has printed so far.
  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;

 private:
  std::filesystem::path folder_;
  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace canopeer::testing_support
