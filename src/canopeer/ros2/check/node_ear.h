#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "canopeer/dds/node.h"

namespace canopeer::ros {

/// Hears which nodes each participant has (ros_discovery_info), in both layouts. Thread-safe.
class NodeEar {
 public:
  [[nodiscard]] Expected<void> listen(Node& node);
  void take(const Sample& sample);
  /// Full names, by participant.
  [[nodiscard]] std::map<ParticipantId, std::set<std::string>> nodes() const;

 private:
  mutable std::mutex mutex_;
  std::map<ParticipantId, std::set<std::string>> nodes_;
  std::shared_ptr<Reader> reader_;  // last: it stops first
};

/// Names of a message of ros_discovery_info; the layout is told by which one fits the octets.
[[nodiscard]] std::set<std::string> node_names_in(const Payload& payload);

}  // namespace canopeer::ros
