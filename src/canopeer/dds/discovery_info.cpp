#include "canopeer/dds/discovery_info.h"

#include <algorithm>

#include "canopeer/cdr/message_names.h"
#include "canopeer/cdr/messages/rmw_dds_common.h"

namespace canopeer::ros {
namespace {

using rmw_dds_common::Gid;
using rmw_dds_common::kHumbleGid;
using rmw_dds_common::kIronGid;
using rmw_dds_common::NodeEntitiesInfo;
using rmw_dds_common::ParticipantEntitiesInfo;

constexpr const char* kTopic = "ros_discovery_info";
constexpr std::size_t kPadding = 3;  ///< octets that writers may add

template <std::size_t N>
Gid<N> gid_of(const Guid& guid) {
  Gid<N> gid;
  std::copy(guid.begin(), guid.end(), gid.data.begin());
  return gid;
}

/// Whether the payload is a message with identifiers of `N` octets and sound names.
template <std::size_t N>
bool has_length(const Payload& payload) {
  try {
    CdrReader reader(payload);
    ParticipantEntitiesInfo<N> message;
    reader(message);
    const auto sound = [](const NodeEntitiesInfo<N>& node) {
      return check_node_name(node.node_name) && check_namespace(node.node_namespace);
    };
    return reader.left() <= kPadding && std::all_of(message.node_entities_info_seq.begin(),
                                                    message.node_entities_info_seq.end(), sound);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

DiscoveryInfo::DiscoveryInfo(Participant& participant, NodeName node)
    : participant_(participant), node_(std::move(node)) {}

Expected<void> DiscoveryInfo::open() {
  const std::string type = dds_type<ParticipantEntitiesInfo<kIronGid>>();
  auto writer = participant_.writer(kTopic, type, kLatchedQos);
  if (!writer) return tl::unexpected(writer.error());
  {
    const std::lock_guard lock(mutex_);
    writer_ = std::move(*writer);
  }
  auto reader = participant_.reader(kTopic, type, {true, true, 100},
                                    [this](Sample&& sample) { learn(sample); });
  if (!reader) return tl::unexpected(reader.error());
  reader_ = std::move(*reader);
  return {};
}

void DiscoveryInfo::add(const Guid& endpoint, bool writer) {
  const std::lock_guard lock(mutex_);
  (writer ? writers_ : readers_).insert(endpoint);
  tell();
}

void DiscoveryInfo::remove(const Guid& endpoint) {
  const std::lock_guard lock(mutex_);
  writers_.erase(endpoint);
  readers_.erase(endpoint);
  tell();
}

void DiscoveryInfo::learn(const Sample& sample) {
  if (participant_of(sample.identity.writer) == participant_.id()) return;
  const bool humble = has_length<kHumbleGid>(sample.payload);
  const bool iron = has_length<kIronGid>(sample.payload);
  if (humble == iron) return;
  const GidLength seen = humble ? GidLength::humble : GidLength::iron;
  const std::lock_guard lock(mutex_);
  if (length_ == seen || length_ == GidLength::both) return;
  length_ = length_ == GidLength::unknown ? seen : GidLength::both;
  tell();
}

void DiscoveryInfo::tell() {
  // A list that was not sent is sent with the next endpoint.
  if (length_ == GidLength::humble) static_cast<void>(writer_->write(message<kHumbleGid>()));
  if (length_ == GidLength::iron) static_cast<void>(writer_->write(message<kIronGid>()));
}

template <std::size_t N>
Payload DiscoveryInfo::message() const {
  constexpr std::array<std::uint8_t, 4> kParticipantEntity = {0, 0, 1, 0xC1};
  Guid self{};
  const ParticipantId id = participant_.id();
  std::copy(id.begin(), id.end(), self.begin());
  std::copy(kParticipantEntity.begin(), kParticipantEntity.end(), self.begin() + id.size());

  NodeEntitiesInfo<N> node;
  node.node_namespace = node_.ns;
  node.node_name = node_.name;
  for (const Guid& guid : readers_) node.reader_gid_seq.push_back(gid_of<N>(guid));
  for (const Guid& guid : writers_) node.writer_gid_seq.push_back(gid_of<N>(guid));
  return to_cdr(ParticipantEntitiesInfo<N>{gid_of<N>(self), {std::move(node)}});
}

}  // namespace canopeer::ros
