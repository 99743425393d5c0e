#include "canopeer/dds/delivery.h"

#include <algorithm>
#include <utility>

namespace canopeer::ros {

Delivery::Lane::Lane(Delivery& delivery, std::size_t most, std::size_t most_octets)
    : delivery_(delivery), most_(std::max<std::size_t>(most, 1)), most_octets_(most_octets) {}

Delivery::Lane::~Lane() { close(); }

void Delivery::Lane::put(std::size_t octets, std::function<void()> tell) {
  const std::lock_guard lock(delivery_.mutex_);
  if (closed_) return;
  delivery_.waiting_.push_back({this, octets, std::move(tell)});
  ++waiting_;
  octets_ += octets;
  while (waiting_ > 1 && (waiting_ > most_ || octets_ > most_octets_)) {
    delivery_.drop(std::find_if(delivery_.waiting_.begin(), delivery_.waiting_.end(),
                                [this](const Item& item) { return item.lane == this; }));
  }
  delivery_.more_.notify_one();
}

void Delivery::Lane::close() {
  std::unique_lock lock(delivery_.mutex_);
  closed_ = true;
  std::erase_if(delivery_.waiting_, [this](const Item& item) { return item.lane == this; });
  delivery_.told_.wait(lock, [this] { return delivery_.telling_ != this; });
}

Delivery::Delivery() : thread_([this](const std::stop_token& stop) { live(stop); }) {}

Delivery::~Delivery() = default;

/// Of a lane and of the queue.
void Delivery::drop(std::deque<Item>::iterator item) {
  --item->lane->waiting_;
  item->lane->octets_ -= item->octets;
  waiting_.erase(item);
}

void Delivery::live(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (more_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    std::function<void()> tell = std::move(waiting_.front().tell);
    telling_ = waiting_.front().lane;
    drop(waiting_.begin());
    lock.unlock();
    tell();
    tell = nullptr;
    lock.lock();
    telling_ = nullptr;
    told_.notify_all();
  }
}

}  // namespace canopeer::ros
