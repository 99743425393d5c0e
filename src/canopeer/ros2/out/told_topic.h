#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "canopeer/dds/node.h"

namespace canopeer::ros {

/// A topic that shows how something is now. Messages are made when they are due: somebody reads
/// them, they are new, and the last one is long enough ago. Who comes later gets the last one, and
/// what is newer soon after. Used from one thread.
template <class Message>
class ToldTopic {
 public:
  using Steady = std::chrono::steady_clock;
  using Make = std::function<std::optional<Message>()>;

  [[nodiscard]] Expected<void> open(Node& node, const std::string& topic) {
    auto publisher = node.advertise<Message>(topic, kLatchedQos);
    if (!publisher) return fail_in(topic, publisher.error());
    publisher_ = std::move(*publisher);
    return {};
  }
  /// What is told next, in place of what was not told yet.
  void offer(Make make) { make_ = std::move(make); }
  /// `rate_hz`: at most so many a second; 0: none.
  void tell_if_due(Steady::time_point now, double rate_hz) {
    if (!make_ || rate_hz <= 0.0) return;
    const auto pause = std::max(std::chrono::duration<double>(1.0 / rate_hz), 9.0 * effort_);
    if (!told_ || now - *told_ >= pause) tell(now);
  }
  /// Whether its time has come or not.
  void tell(Steady::time_point now) {
    if (!make_ || publisher_.readers() == 0) return;
    const auto begun = Steady::now();
    if (const auto message = std::exchange(make_, nullptr)()) publisher_.publish(*message);
    effort_ = Steady::now() - begun;
    told_ = now;
  }

 private:
  Publisher<Message> publisher_;
  Make make_;
  std::optional<Steady::time_point> told_;
  std::chrono::duration<double> effort_{0.0};  ///< of the last one
};

}  // namespace canopeer::ros
