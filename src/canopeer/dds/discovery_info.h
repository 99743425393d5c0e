#pragma once

#include <memory>
#include <mutex>
#include <set>

#include "canopeer/dds/names.h"
#include "canopeer/dds/participant.h"

namespace canopeer::ros {

/// Tells others which node there is and which endpoints are its own, for `ros2 node list`. An
/// identifier has 24 octets up to Humble and 16 from Iron on, under one type name, and the wrong
/// one aborts a Humble node: so nothing is said until a peer has shown its length, nor after peers
/// of both have. Thread-safe.
class DiscoveryInfo {
 public:
  DiscoveryInfo(Participant& participant, NodeName node);
  /// Begins to listen.
  [[nodiscard]] Expected<void> open();
  void add(const Guid& endpoint, bool writer);
  void remove(const Guid& endpoint);

 private:
  enum class GidLength { unknown, humble, iron, both };
  void learn(const Sample& sample);
  void tell();
  template <std::size_t N>
  [[nodiscard]] Payload message() const;

  Participant& participant_;
  const NodeName node_;
  std::mutex mutex_;  ///< of what follows
  GidLength length_ = GidLength::unknown;
  std::set<Guid> writers_;
  std::set<Guid> readers_;
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<Reader> reader_;  ///< goes first
};

}  // namespace canopeer::ros
