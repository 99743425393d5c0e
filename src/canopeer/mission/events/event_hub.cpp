#include "canopeer/mission/events/event_hub.h"

#include <utility>

#include "canopeer/mission/events/watcher_queue.h"

namespace canopeer {
namespace {

void join(EventNeeds& all, const EventNeeds& one) {
  all.map |= one.map;
  all.plan |= one.plan;
  all.surface |= one.surface;
}

}  // namespace

EventHub::EventHub() = default;
EventHub::~EventHub() { finish(); }

void EventHub::keep(Keeper& keeper) {
  keepers_.push_back(&keeper);
  join(needs_, keeper.needs());
}

void EventHub::watch(std::shared_ptr<Watcher> watcher, const WatchOptions& options,
                     bool simulated_time) {
  join(needs_, watcher->needs());
  queues_.push_back(std::make_unique<WatcherQueue>(std::move(watcher), options, simulated_time));
}

Expected<void> EventHub::emit(Event event) {
  Expected<void> outcome;
  for (Keeper* const keeper : keepers_) {
    auto kept = keeper->on_event(event);
    if (!kept && outcome) outcome = std::move(kept);
  }
  if (!queues_.empty()) {
    const auto shared = std::make_shared<const Event>(std::move(event));
    for (const auto& queue : queues_) queue->put(shared);
  }
  return outcome;
}

void EventHub::finish(std::chrono::milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  for (const auto& queue : queues_) queue->close();
  for (const auto& queue : queues_) queue->wait(until);
}

std::vector<EventHub::Watched> EventHub::watched() const {
  std::vector<Watched> all;
  for (const auto& queue : queues_) all.push_back(queue->watched());
  return all;
}

}  // namespace canopeer
