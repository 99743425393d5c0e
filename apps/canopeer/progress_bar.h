#pragma once

#include <chrono>

#include "canopeer/mission/mission.h"

namespace canopeer::app {

/// Shows how far a mission is: a bar that is redrawn on a terminal, else a plain line per segment;
/// nothing when quiet.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  void show(const MissionProgress& progress);
  /// Leaves the line.
  void finish();

 private:
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  int last_segment_ = -1;
  MissionProgress last_;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point drawn_at_;
};

}  // namespace canopeer::app
