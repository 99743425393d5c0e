#include "canopeer/mission/events/watcher_queue.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace canopeer {

struct WatcherQueue::Shared {
  Shared(std::shared_ptr<Watcher> w, WatchOptions o, bool waits)
      : watcher(std::move(w)), options(std::move(o)), mission_waits(waits) {}

  std::shared_ptr<Watcher> watcher;
  const WatchOptions options;
  const bool mission_waits;
  mutable std::mutex mutex;  // of what follows
  std::condition_variable changed;
  std::deque<std::shared_ptr<const Event>> waiting;
  std::int64_t lost = 0;
  std::int64_t lost_untold = 0;
  std::string failure;
  bool finishing = false;
  bool left_behind = false;
  bool gone = false;  // its thread has ended, or nobody waits for it any more

  void run();
  void watch_until_finished();
  bool next(std::shared_ptr<const Event>& event, std::int64_t& lost_before);
  void end(std::string why);
};

WatcherQueue::WatcherQueue(std::shared_ptr<Watcher> watcher, const WatchOptions& options,
                           bool simulated_time)
    : shared_(std::make_shared<Shared>(std::move(watcher), options,
                                       options.wait_in_simulated_time && simulated_time)) {
  // Detached: a watcher that never comes back must not hold the run at its end.
  std::thread([shared = shared_] { shared->run(); }).detach();
}

WatcherQueue::~WatcherQueue() {
  close();
  wait(std::chrono::steady_clock::now());
}

void WatcherQueue::put(std::shared_ptr<const Event> event) {
  Shared& s = *shared_;
  std::unique_lock lock(s.mutex);
  const std::size_t room = std::max<std::size_t>(1, s.options.queue);
  if (s.mission_waits) {
    s.changed.wait(lock, [&] { return s.gone || s.waiting.size() < room; });
  }
  if (s.gone) return;
  if (s.waiting.size() >= room) {
    s.waiting.pop_front();
    ++s.lost;
    ++s.lost_untold;
  }
  s.waiting.push_back(std::move(event));
  s.changed.notify_all();
}

void WatcherQueue::close() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  shared_->finishing = true;
  shared_->changed.notify_all();
}

void WatcherQueue::wait(std::chrono::steady_clock::time_point until) {
  Shared& s = *shared_;
  std::unique_lock lock(s.mutex);
  const auto gone = [&] { return s.gone; };
  if (s.mission_waits) s.changed.wait(lock, gone);
  if (s.changed.wait_until(lock, until, gone)) return;
  s.left_behind = true;
  s.gone = true;
  s.lost += static_cast<std::int64_t>(s.waiting.size());
  s.waiting.clear();
}

EventHub::Watched WatcherQueue::watched() const {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return {shared_->options.name, shared_->lost, shared_->failure, shared_->left_behind};
}

void WatcherQueue::Shared::run() {
  try {
    watch_until_finished();
    end("");
  } catch (const std::exception& error) {
    end(error.what());
  } catch (...) {
    end("an exception of unknown type");
  }
}

void WatcherQueue::Shared::watch_until_finished() {
  std::shared_ptr<const Event> event;
  std::int64_t lost_before = 0;
  while (next(event, lost_before)) {
    if (lost_before > 0) watcher->on_loss(lost_before);
    watcher->on_event(*event);
    event.reset();
  }
}

/// False: there is none and there will be none.
bool WatcherQueue::Shared::next(std::shared_ptr<const Event>& event, std::int64_t& lost_before) {
  std::unique_lock lock(mutex);
  changed.wait(lock, [this] { return finishing || !waiting.empty(); });
  if (waiting.empty()) return false;
  event = std::move(waiting.front());
  waiting.pop_front();
  lost_before = std::exchange(lost_untold, 0);
  changed.notify_all();
  return true;
}

void WatcherQueue::Shared::end(std::string why) {
  const std::lock_guard<std::mutex> lock(mutex);
  failure = std::move(why);
  gone = true;
  lost += static_cast<std::int64_t>(waiting.size());
  waiting.clear();
  changed.notify_all();
}

}  // namespace canopeer
