#pragma once

#include <string>
#include <vector>

namespace canopeer::testing_support {

/// Another process, started; its standard output can be read, its standard input stays open until
/// `stop`. Killed when this goes.
class Child {
 public:
  explicit Child(const std::vector<std::string>& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Until it has said so, or has ended.
  std::string read_line();
  /// All it says until it ends.
  std::string read_all();
  /// As kill -9 does.
  void kill();
  /// Ends its standard input and waits for it.
  void stop();

 private:
  int process_ = -1;
  int input_ = -1;
  int output_ = -1;
};

}  // namespace canopeer::testing_support
