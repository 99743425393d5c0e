#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/dds/participant.h"

// Who else is in the domain, and which of this machine's addresses are spoken on.

namespace canopeer::ros {

/// What discovery told so far. Thread-safe; no lock is held while anything else is called.
class KnownPeers {
 public:
  /// Known ones keep their `since`.
  void put(Peer peer);
  void put(const Endpoint& endpoint);
  /// With all its endpoints.
  void remove_peer(const ParticipantId& peer);
  void remove_endpoint(const Guid& endpoint);
  [[nodiscard]] std::vector<Peer> peers() const;
  [[nodiscard]] std::optional<Peer> peer(const ParticipantId& id) const;
  [[nodiscard]] std::vector<Endpoint> endpoints() const;
  [[nodiscard]] std::optional<Endpoint> endpoint(const Guid& guid) const;
  [[nodiscard]] Rmw rmw_of(const ParticipantId& peer) const;

 private:
  mutable std::mutex mutex_;
  std::map<ParticipantId, Peer> peers_;
  std::map<Guid, Endpoint> endpoints_;
};

/// Addresses to speak on: loopback alone, all ("any": an empty list), or those named and loopback,
/// where programs on this machine listen.
[[nodiscard]] std::vector<std::string> used_interfaces(const std::vector<std::string>& named);

/// Whether the options are legal and this machine has the addresses.
[[nodiscard]] Expected<void> check_here(const ParticipantOptions& options);

}  // namespace canopeer::ros
