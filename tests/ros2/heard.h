#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "../dds/ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {

/// The last message of a topic, and how many came.
template <class Message>
class Heard {
 public:
  Heard(Node& node, const std::string& topic, const Qos& qos = kLatchedQos)
      : subscription_(
            must(node.subscribe<Message>(topic, qos, [this](Message&& message, const Guid&) {
              const std::lock_guard lock(mutex_);
              last_ = std::move(message);
              ++count_;
            }))) {}
  [[nodiscard]] std::optional<Message> last() const {
    const std::lock_guard lock(mutex_);
    return last_;
  }
  [[nodiscard]] int count() const {
    const std::lock_guard lock(mutex_);
    return count_;
  }
  /// Waits until the last message is so.
  template <class Condition>
  [[nodiscard]] bool comes_to(Condition is_so) const {
    return testing_support::eventually([&] {
      const auto message = last();
      return message && is_so(*message);
    });
  }
  [[nodiscard]] bool comes() const {
    return comes_to([](const Message&) { return true; });
  }

 private:
  mutable std::mutex mutex_;
  std::optional<Message> last_;
  int count_ = 0;
  Subscription subscription_;  // last: its callback uses all above
};

}  // namespace canopeer::ros
