#include "canopeer/replay/replay_watcher.h"

#include <iterator>
#include <stdexcept>
#include <utility>

namespace canopeer {
namespace {

/// What comes between a frame and the fruits in it belongs to one view.
bool within_a_view(const Event& event) {
  return std::holds_alternative<FrameTaken>(event) ||
         std::holds_alternative<FrameOnTheWay>(event) ||
         std::holds_alternative<MapChanged>(event) || std::holds_alternative<Planned>(event);
}

}  // namespace

ReplayWatcher::ReplayWatcher(std::unique_ptr<RunFrames> frames, std::shared_ptr<ReplayLog> log)
    : frames_(std::move(frames)), log_(std::move(log)), waiting_(frames_->first()) {}

void ReplayWatcher::on_event(const Event& event) {
  std::vector<Frame> frames = frames_->of(event);
  std::move(frames.begin(), frames.end(), std::back_inserter(waiting_));
  if (!within_a_view(event)) write();
}

void ReplayWatcher::on_loss(std::int64_t /*events*/) { frames_->missed(); }

/// An exception ends the watching and is said (Watcher): a full disk, mostly.
void ReplayWatcher::write() {
  if (auto ok = log_->append(waiting_); !ok) throw std::runtime_error(ok.error().message);
  waiting_.clear();
}

}  // namespace canopeer
