#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/mission/listeners.h"

namespace canopeer {

class WatcherQueue;

/// Hands events to keepers, at once and in order, and to watchers, each through a queue of its own
/// to a thread of its own. Used from the mission's thread.
class EventHub {
 public:
  EventHub();
  ~EventHub();
  EventHub(const EventHub&) = delete;
  EventHub& operator=(const EventHub&) = delete;

  /// Outlives the hub.
  void keep(Keeper& keeper);
  /// `simulated_time`: the mission's clock stands still while a watcher that may is waited for.
  void watch(std::shared_ptr<Watcher> watcher, const WatchOptions& options, bool simulated_time);

  /// What the listeners together want.
  [[nodiscard]] const EventNeeds& needs() const { return needs_; }

  /// The error is a keeper's: the first one; the others have got the event all the same.
  [[nodiscard]] Expected<void> emit(Event event);

  /// No more events: watchers may finish what waits, for `patience` all together; who is not done
  /// then is left behind in its thread.
  void finish(std::chrono::milliseconds patience = std::chrono::milliseconds(2000));

  /// What became of a watcher.
  struct Watched {
    std::string name;
    std::int64_t lost = 0;  ///< events
    std::string failure;    ///< empty: none
    bool left_behind = false;
  };
  [[nodiscard]] std::vector<Watched> watched() const;

 private:
  std::vector<Keeper*> keepers_;
  std::vector<std::unique_ptr<WatcherQueue>> queues_;
  EventNeeds needs_;
};

}  // namespace canopeer
