#pragma once

#include <cstddef>

#include "canopeer/mission/listeners.h"
#include "progress_bar.h"

namespace canopeer::app {

/// Shows how far a mission is.
class MissionProgress : public Watcher {
 public:
  explicit MissionProgress(bool quiet) : bar_(quiet) {}
  void on_event(const Event& event) override;

 private:
  void show(int segment, double t_s, std::size_t fruits);

  ProgressBar bar_;
  RunBegun run_;
  SegmentEvent segment_;
  int views_ = 0;
  int frames_ = 0;  ///< on the way, since the program began
};

}  // namespace canopeer::app
