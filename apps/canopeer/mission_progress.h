#pragma once

#include <string>

#include "canopeer/mission/listeners.h"
#include "progress_bar.h"

namespace canopeer::app {

/// Shows how far a mission is.
class MissionProgress : public Watcher {
 public:
  explicit MissionProgress(bool quiet) : bar_(quiet) {}
  void on_event(const Event& event) override;

 private:
  void show(const ViewEvent& view);

  ProgressBar bar_;
  RunBegun run_;
  SegmentEvent segment_;
};

}  // namespace canopeer::app
