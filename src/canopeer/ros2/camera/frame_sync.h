#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

struct FrameSyncOptions {
  std::int64_t max_difference = 20'000'000;  ///< between stamps of what belongs together, ns
  std::size_t max_items = 30;                ///< waiting in a stream; the oldest goes
  std::size_t max_octets = 192u << 20;       ///< waiting in all streams together
};

/// Joins items of several streams by their stamps. Each item of stream 0 is a set when every other
/// stream has one within `max_difference`; the nearest is taken, and each at most once. Streams may
/// jitter, drop items, run at different rates and be late against each other; items of a stream
/// may come out of order until one after them was used. Sets come in the order of their stamps.
/// Not thread-safe.
template <class Item>
class FrameSync {
 public:
  struct Set {
    Stamp stamp = 0;          ///< of stream 0
    std::vector<Item> items;  ///< one of each stream
  };

  FrameSync(std::size_t streams, const FrameSyncOptions& options)
      : options_(options), streams_(streams) {}

  /// Takes an item and returns the sets that are complete now.
  std::vector<Set> add(std::size_t stream, Stamp stamp, Item item, std::size_t octets) {
    Stream& to = streams_[stream];
    if (to.newest && stamp < *to.newest - kJump) forget();  // the clock was set back
    if (to.used && stamp <= *to.used) {
      ++dropped_;
      return {};
    }
    const auto place =
        std::upper_bound(to.queue.begin(), to.queue.end(), stamp,
                         [](Stamp at, const Waiting& waiting) { return at < waiting.stamp; });
    to.queue.insert(place, Waiting{stamp, std::move(item), octets});
    if (to.newest && stamp > *to.newest) {
      to.gaps = {to.gaps[1], stamp - *to.newest};
    }
    to.newest = std::max(to.newest.value_or(stamp), stamp);
    octets_ += octets;
    std::vector<Set> sets = join();
    keep_bounds();
    return sets;
  }

  /// Items that found no partners, or came too late for it.
  [[nodiscard]] std::int64_t dropped() const { return dropped_; }
  [[nodiscard]] std::size_t waiting(std::size_t stream) const {
    return streams_[stream].queue.size();
  }

  /// As if nothing had come yet.
  void forget() {
    for (Stream& stream : streams_) stream = Stream{};
    octets_ = 0;
  }

 private:
  static constexpr std::int64_t kJump = 5 * kNanosecondsPerSecond;
  struct Waiting {
    Stamp stamp = 0;
    Item item;
    std::size_t octets = 0;
  };
  struct Stream {
    std::deque<Waiting> queue;           // by stamp
    std::optional<Stamp> newest;         // stamp that came
    std::optional<Stamp> used;           // stamp of a set
    std::array<std::int64_t, 2> gaps{};  // between the newest three; 0: not known
    [[nodiscard]] std::int64_t pace() const { return std::min(gaps[0], gaps[1]); }
  };
  enum class Found { yes, no, not_yet };

  /// The partner of stream 0's item at `stamp`. It is known when nothing nearer can come: the
  /// stream has passed `stamp`, or its next item, at the pace it comes, will be farther off.
  Found find(const Stream& stream, Stamp stamp, std::size_t* index) const {
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < stream.queue.size(); ++i) {
      const std::int64_t difference = std::abs(stream.queue[i].stamp - stamp);
      if (difference >= best) continue;
      best = difference;
      *index = i;
    }
    const bool within = best <= options_.max_difference;
    const bool passed = stream.newest && *stream.newest >= stamp;
    if (within && (passed || best == 0 || 2 * best < stream.pace())) {
      return Found::yes;
    }
    const bool over = stream.newest && *stream.newest > stamp + options_.max_difference;
    if (!within && over) return Found::no;
    return Found::not_yet;
  }

  /// All sets whose partners are known. An item that waits holds up those after it.
  std::vector<Set> join() {
    std::vector<Set> sets;
    std::vector<std::size_t> partners(streams_.size(), 0);
    while (!streams_[0].queue.empty()) {
      const Stamp stamp = streams_[0].queue.front().stamp;
      Found found = Found::yes;
      for (std::size_t s = 1; s < streams_.size(); ++s) {
        const Found one = find(streams_[s], stamp, &partners[s]);
        if (one == Found::no) found = Found::no;
        if (one == Found::not_yet && found == Found::yes) found = Found::not_yet;
      }
      if (found == Found::not_yet) break;
      if (found == Found::no) {
        drop_front(streams_[0]);
        continue;
      }
      sets.push_back(take(partners));
    }
    return sets;
  }

  Set take(const std::vector<std::size_t>& partners) {
    Set set{streams_[0].queue.front().stamp, {}};
    for (std::size_t s = 0; s < streams_.size(); ++s) {
      Stream& stream = streams_[s];
      for (std::size_t i = 0; i < partners[s]; ++i) drop_front(stream);
      Waiting& front = stream.queue.front();
      stream.used = front.stamp;
      set.items.push_back(std::move(front.item));
      octets_ -= front.octets;
      stream.queue.pop_front();
    }
    return set;
  }

  void drop_front(Stream& stream) {
    octets_ -= stream.queue.front().octets;
    stream.queue.pop_front();
    ++dropped_;
  }

  void keep_bounds() {
    for (Stream& stream : streams_) {
      while (stream.queue.size() > options_.max_items) drop_front(stream);
    }
    while (octets_ > options_.max_octets) {
      const auto fullest = std::max_element(
          streams_.begin(), streams_.end(),
          [](const Stream& a, const Stream& b) { return a.queue.size() < b.queue.size(); });
      if (fullest->queue.empty()) break;
      drop_front(*fullest);
    }
  }

  const FrameSyncOptions options_;
  std::vector<Stream> streams_;
  std::size_t octets_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace canopeer::ros
