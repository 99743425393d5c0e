#include "canopeer/dds/peers.h"

#include <arpa/inet.h>
#include <ifaddrs.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace canopeer::ros {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kMostPayload = std::size_t{1} << 30;

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

std::vector<std::string> own_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return addresses;
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    const auto* address = reinterpret_cast<const sockaddr_in*>(at->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text, sizeof(text)) != nullptr) {
      addresses.emplace_back(text);
    }
  }
  freeifaddrs(first);
  return addresses;
}

bool holds(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

ParticipantId participant_of(const Guid& guid) {
  ParticipantId id{};
  std::copy_n(guid.begin(), id.size(), id.begin());
  return id;
}

Rmw Peer::rmw() const {
  if (vendor == VendorId{0x01, 0x0F}) return Rmw::fastrtps;
  if (vendor == VendorId{0x01, 0x10}) return Rmw::cyclonedds;
  return Rmw::unknown;
}

std::string Peer::vendor_name() const {
  switch (rmw()) {
    case Rmw::fastrtps:
      return "eProsima Fast DDS";
    case Rmw::cyclonedds:
      return "Eclipse Cyclone DDS";
    case Rmw::unknown:
      break;
  }
  char octets[8] = {};
  std::snprintf(octets, sizeof(octets), "%02x.%02x", vendor[0], vendor[1]);
  return octets;
}

Expected<void> ParticipantOptions::validate() const {
  if (domain < 0 || domain > 232) {
    return fail("domain " + std::to_string(domain) + ": must be 0 … 232");
  }
  if (max_payload == 0 || max_payload > kMostPayload) {
    return fail("max_payload: must be 1 octet … 1 GiB");
  }
  if (holds(interfaces, "any") && interfaces.size() > 1) {
    return fail("interfaces: \"any\" stands alone");
  }
  for (const std::string& address : interfaces) {
    if (address != "any" && !is_ipv4(address)) {
      return fail("interfaces: '" + address + "' is no IPv4 address");
    }
  }
  for (const std::string& address : peers) {
    if (!is_ipv4(address)) return fail("peers: '" + address + "' is no IPv4 address");
  }
  return {};
}

std::vector<std::string> used_interfaces(const std::vector<std::string>& named) {
  if (holds(named, "any")) return {};
  std::vector<std::string> used = named;
  if (!holds(used, kLoopback)) used.emplace_back(kLoopback);
  return used;
}

Expected<void> check_here(const ParticipantOptions& options) {
  auto valid = options.validate();
  if (!valid) return valid;
  const std::vector<std::string> own = own_addresses();
  for (const std::string& address : used_interfaces(options.interfaces)) {
    if (holds(own, address)) continue;
    std::string message = "interfaces: this machine has no address " + address + "; it has";
    for (const std::string& other : own) message += " " + other;
    return fail(own.empty() ? message + " none: is the network (or `ip link set lo up`) on?"
                            : message);
  }
  return {};
}

void KnownPeers::put(Peer peer) {
  const std::lock_guard lock(mutex_);
  const auto known = peers_.find(peer.id);
  if (known != peers_.end()) peer.since = known->second.since;
  peers_[peer.id] = std::move(peer);
}

void KnownPeers::put(const Endpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  endpoints_[endpoint.guid] = endpoint;
}

void KnownPeers::remove_peer(const ParticipantId& peer) {
  const std::lock_guard lock(mutex_);
  peers_.erase(peer);
  std::erase_if(endpoints_, [&](const auto& item) { return participant_of(item.first) == peer; });
}

void KnownPeers::remove_endpoint(const Guid& endpoint) {
  const std::lock_guard lock(mutex_);
  endpoints_.erase(endpoint);
}

std::vector<Peer> KnownPeers::peers() const {
  const std::lock_guard lock(mutex_);
  std::vector<Peer> all;
  for (const auto& [id, peer] : peers_) all.push_back(peer);
  return all;
}

std::vector<Endpoint> KnownPeers::endpoints() const {
  const std::lock_guard lock(mutex_);
  std::vector<Endpoint> all;
  for (const auto& [guid, endpoint] : endpoints_) all.push_back(endpoint);
  return all;
}

std::optional<Peer> KnownPeers::peer(const ParticipantId& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = peers_.find(id);
  if (found == peers_.end()) return std::nullopt;
  return found->second;
}

std::optional<Endpoint> KnownPeers::endpoint(const Guid& guid) const {
  const std::lock_guard lock(mutex_);
  const auto found = endpoints_.find(guid);
  if (found == endpoints_.end()) return std::nullopt;
  return found->second;
}

Rmw KnownPeers::rmw_of(const ParticipantId& peer) const {
  const std::lock_guard lock(mutex_);
  const auto found = peers_.find(peer);
  if (found != peers_.end()) return found->second.rmw();
  // Said by an endpoint before its participant: an id begins with its vendor's.
  Peer unknown;
  unknown.vendor = {peer[0], peer[1]};
  return unknown.rmw();
}

}  // namespace canopeer::ros
