#pragma once

#include <memory>
#include <vector>

#include "canopeer/mission/listeners.h"
#include "canopeer/replay/replay_log.h"
#include "canopeer/replay/run_frames.h"

namespace canopeer {

/// Writes a run's frames to its log as they come, a view's together. In simulated time it wants to
/// be waited for (WatchOptions::wait_in_simulated_time), or frames are missing.
class ReplayWatcher : public Watcher {
 public:
  ReplayWatcher(std::unique_ptr<RunFrames> frames, std::shared_ptr<ReplayLog> log);
  [[nodiscard]] EventNeeds needs() const override {
    return {.map = true, .plan = true, .surface = true};
  }
  void on_event(const Event& event) override;
  void on_loss(std::int64_t events) override;

 private:
  void write();

  std::unique_ptr<RunFrames> frames_;
  std::shared_ptr<ReplayLog> log_;
  std::vector<Frame> waiting_;
};

}  // namespace canopeer
