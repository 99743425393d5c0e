#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// How old messages are when they come in, by their stamps and our clock: the way they take and
/// what the clocks differ by. The shortest way is short, so the least age tells the clocks apart.
class ClockDifference {
 public:
  void add(std::int64_t age_ns) {
    ages_.push_back(age_ns);
    if (ages_.size() > kKept) ages_.pop_front();
  }
  /// Of the last 200 messages, s. Negative: the sender's clock is ahead. Nothing: none came.
  [[nodiscard]] std::optional<double> least_age_s() const {
    if (ages_.empty()) return std::nullopt;
    return seconds(*std::min_element(ages_.begin(), ages_.end()));
  }

 private:
  static constexpr std::size_t kKept = 200;
  std::deque<std::int64_t> ages_;
};

}  // namespace canopeer::ros
