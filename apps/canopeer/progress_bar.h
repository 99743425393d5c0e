#pragma once

#include <chrono>
#include <string>

namespace canopeer::app {

/// Shows how far a command is: a bar that is redrawn on a terminal, else a plain line per stage;
/// nothing when quiet.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  /// `fraction` 0 … 1 of the work is done; `text` says it in words. A stage is what gets a line of
  /// its own where there is no terminal: its last text.
  void show(double fraction, const std::string& text, int stage);
  /// Leaves the line.
  void finish();

 private:
  void draw();

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  double fraction_ = 0.0;
  int stage_ = -1;
  std::string text_;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point drawn_at_;
};

}  // namespace canopeer::app
