#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/cdr/message_names.h"
#include "canopeer/dds/participant.h"

namespace canopeer::ros {

class DiscoveryInfo;

/// Who a node is, and where.
struct NodeOptions {
  std::string name = "canopeer";
  std::string ns = "/";                       ///< namespace: "/", "/left_row"
  std::map<std::string, std::string> remaps;  ///< from : to, as after `--ros-args -r`
  ParticipantOptions participant;
  /// Listed in `ros2 node list` (as soon as peers have shown which form of the list they know).
  bool announce = true;
};

/// A publisher of messages of one type. Thread-safe.
template <class Message>
class Publisher {
 public:
  Publisher() = default;
  explicit Publisher(std::shared_ptr<Writer> writer) : writer_(std::move(writer)) {}
  /// False: nobody took it, or the queue was full.
  bool publish(const Message& message) const {
    return writer_ != nullptr && writer_->write(to_cdr(message)).has_value();
  }
  /// How many readers there are: what nobody reads need not be made.
  [[nodiscard]] std::size_t readers() const {
    return writer_ == nullptr ? 0 : writer_->matched().size();
  }

 private:
  std::shared_ptr<Writer> writer_;
};

/// Whether it is longer than any sound message of its type; some types do not say.
template <class Message>
[[nodiscard]] bool is_too_long(const Payload& payload) {
  if constexpr (requires { Message::kMostOctets; }) {
    return payload.size() > Message::kMostOctets;
  } else {
    return false;
  }
}

/// Unsubscribes when the last copy goes.
using Subscription = std::shared_ptr<Reader>;

/// A ROS 2 node over DDS: names, remapping, publishers, subscriptions. Services and actions:
/// service.h, action.h. Thread-safe; outlives what it made.
class Node {
 public:
  /// The error: bad names or options, or no participant could be made.
  [[nodiscard]] static Expected<std::unique_ptr<Node>> make(const NodeOptions& options);
  ~Node();

  /// "joint_states" → "/ns/joint_states", "~/start" → "/ns/node/start", remapped. Throws nothing;
  /// a name that ROS would refuse is an error of the calls below.
  [[nodiscard]] std::string resolve(const std::string& name) const;
  [[nodiscard]] const NodeOptions& options() const { return options_; }
  /// "/ns/name".
  [[nodiscard]] std::string full_name() const;
  [[nodiscard]] Participant& participant() { return *participant_; }

  template <class Message>
  [[nodiscard]] Expected<Publisher<Message>> advertise(const std::string& topic,
                                                       const Qos& qos = {}) {
    auto writer = topic_writer(topic, dds_type<Message>(), qos);
    if (!writer) return tl::unexpected(writer.error());
    return Publisher<Message>(std::move(*writer));
  }
  /// `on_message(Message&&, const Guid& writer)`, in the node's thread, one at a time.
  /// Malformed ones, and those longer than the type's `kMostOctets`, are counted and dropped.
  template <class Message, class Callback>
  [[nodiscard]] Expected<Subscription> subscribe(const std::string& topic, const Qos& qos,
                                                 Callback on_message) {
    return topic_reader(topic, dds_type<Message>(), qos,
                        [this, on_message = std::move(on_message)](Sample&& sample) mutable {
                          if (is_too_long<Message>(sample.payload)) return count_malformed();
                          auto message = from_cdr<Message>(sample.payload);
                          if (message) {
                            on_message(std::move(*message), sample.identity.writer);
                          } else {
                            count_malformed();
                          }
                        });
  }

  /// Who publishes on or subscribes to a topic, ROS name.
  [[nodiscard]] std::vector<Endpoint> publishers_of(const std::string& topic) const;
  [[nodiscard]] std::vector<Endpoint> subscribers_of(const std::string& topic) const;
  [[nodiscard]] Rmw rmw_of(const Guid& endpoint) const;

  /// Payloads that were no message of their type, since the node began, requests of peers whose
  /// middleware is not known, or what was too long for any node of this process.
  [[nodiscard]] std::int64_t malformed() const;
  void count_malformed() { ++malformed_; }

  // For services: endpoints by DDS name, listed as the node's own.
  /// `prefix` and the resolved name; the error: ROS would refuse it.
  [[nodiscard]] Expected<std::string> dds_name(const std::string& prefix,
                                               const std::string& name) const;
  [[nodiscard]] Expected<std::shared_ptr<Writer>> dds_writer(const std::string& topic,
                                                             const std::string& type,
                                                             const Qos& qos,
                                                             const std::string& user_data,
                                                             std::function<void()> on_match = {});
  [[nodiscard]] Expected<std::shared_ptr<Reader>> dds_reader(
      const std::string& topic, const std::string& type, const Qos& qos,
      std::function<void(Sample&&)> on_sample, const std::string& user_data);

 private:
  explicit Node(NodeOptions options);
  [[nodiscard]] Expected<std::shared_ptr<Writer>> topic_writer(const std::string& topic,
                                                               const std::string& type,
                                                               const Qos& qos);
  [[nodiscard]] Expected<std::shared_ptr<Reader>> topic_reader(
      const std::string& topic, const std::string& type, const Qos& qos,
      std::function<void(Sample&&)> on_sample);

  NodeOptions options_;
  std::atomic<std::int64_t> malformed_{0};
  std::unique_ptr<Participant> participant_;
  std::shared_ptr<DiscoveryInfo> discovery_;  ///< none: not announced
};

}  // namespace canopeer::ros
