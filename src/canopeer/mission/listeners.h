#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "canopeer/mission/event.h"

namespace canopeer {

/// Keeps what happens: record, results. Called in the mission's thread, in order, with every event.
/// A run whose keeper fails ends with that error; what was kept until then must stay readable.
class Keeper {
 public:
  virtual ~Keeper() = default;
  [[nodiscard]] virtual EventNeeds needs() const { return {}; }
  [[nodiscard]] virtual Expected<void> on_event(const Event& event) = 0;
};

/// Watches: progress bar, live view, topics. Called in a thread of its own, in order. It may lose
/// events when it is slow. It can neither block nor change nor fail a run; only one that asks for
/// it (WatchOptions::wait_in_simulated_time) is waited for. One that does not come to an end is
/// left behind in its thread, so a watcher owns whatever it touches.
class Watcher {
 public:
  virtual ~Watcher() = default;
  [[nodiscard]] virtual EventNeeds needs() const { return {}; }
  /// An exception ends the watching, not the run.
  virtual void on_event(const Event& event) = 0;
  /// So many events were lost before the one that comes next.
  virtual void on_loss(std::int64_t /*events*/) {}
};

/// How a watcher is told: its name, and how many events may wait.
struct WatchOptions {
  std::string name = "watcher";  ///< for messages
  std::size_t queue = 256;       ///< events that wait, at least 1; when full the oldest is lost
  /// In simulated time the mission waits instead, for room in the queue and at the end: for
  /// recordings.
  bool wait_in_simulated_time = false;
};

}  // namespace canopeer
