#pragma once

#include <chrono>
#include <memory>

#include "canopeer/mission/events/event_hub.h"

namespace canopeer {

/// A watcher in a thread of its own, behind a queue of bounded length.
class WatcherQueue {
 public:
  WatcherQueue(std::shared_ptr<Watcher> watcher, const WatchOptions& options, bool simulated_time);
  ~WatcherQueue();
  WatcherQueue(const WatcherQueue&) = delete;
  WatcherQueue& operator=(const WatcherQueue&) = delete;

  /// Returns at once; only a watcher that may make simulated time wait is waited for.
  void put(std::shared_ptr<const Event> event);
  /// Nothing more will come: the watcher may finish what waits.
  void close();
  /// Until it has, or until then; who may make simulated time wait is waited for. May be called
  /// again.
  void wait(std::chrono::steady_clock::time_point until);
  [[nodiscard]] EventHub::Watched watched() const;

 private:
  struct Shared;  // outlives the queue when the watcher's thread does
  std::shared_ptr<Shared> shared_;
};

}  // namespace canopeer
