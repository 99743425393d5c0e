#include "canopeer/dds/node.h"

#include <utility>

#include "canopeer/dds/discovery_info.h"
#include "canopeer/dds/names.h"

namespace canopeer::ros {
namespace {

NodeName name_of(const NodeOptions& options) { return {options.ns, options.name}; }

/// A handle that leaves the node's list when it goes.
template <class Endpoint>
std::shared_ptr<Endpoint> listed(std::unique_ptr<Endpoint> endpoint, bool writer,
                                 const std::shared_ptr<DiscoveryInfo>& discovery) {
  if (discovery == nullptr) return endpoint;
  const Guid guid = endpoint->guid();
  discovery->add(guid, writer);
  return {endpoint.release(), [discovery, guid](Endpoint* gone) {
            delete gone;
            discovery->remove(guid);
          }};
}

std::vector<Endpoint> of_topic(const Participant& participant, const std::string& topic,
                               bool writers) {
  std::vector<Endpoint> found = participant.endpoints();
  std::erase_if(found, [&](const Endpoint& endpoint) {
    return endpoint.writer != writers || endpoint.topic != topic;
  });
  return found;
}

}  // namespace

Node::Node(NodeOptions options) : options_(std::move(options)) {}
Node::~Node() = default;

Expected<std::unique_ptr<Node>> Node::make(const NodeOptions& options) {
  if (const auto sound = check_node_name(options.name); !sound) {
    return tl::unexpected(sound.error());
  }
  if (const auto sound = check_namespace(options.ns); !sound) return tl::unexpected(sound.error());
  for (const auto& [from, to] : options.remaps) {
    for (const std::string& side : {from, to}) {
      const auto name = expand_name(side, name_of(options));
      if (!name) return fail_in("remap " + from + ":=" + to, name.error());
    }
  }
  auto participant = Participant::join(options.participant);
  if (!participant) return tl::unexpected(participant.error());

  std::unique_ptr<Node> node(new Node(options));
  node->participant_ = std::move(*participant);
  if (options.announce) {
    node->discovery_ = std::make_shared<DiscoveryInfo>(*node->participant_, name_of(options));
    const auto opened = node->discovery_->open();
    if (!opened) return tl::unexpected(opened.error());
  }
  return node;
}

std::string Node::resolve(const std::string& name) const {
  return resolve_name(name, name_of(options_), options_.remaps).value_or(name);
}

Expected<std::string> Node::dds_name(const std::string& prefix, const std::string& name) const {
  auto resolved = resolve_name(name, name_of(options_), options_.remaps);
  if (!resolved) return resolved;
  return prefix + *resolved;
}

std::string Node::full_name() const { return name_of(options_).full(); }

Expected<std::shared_ptr<Writer>> Node::dds_writer(const std::string& topic,
                                                   const std::string& type, const Qos& qos,
                                                   const std::string& user_data,
                                                   std::function<void()> on_match) {
  auto writer = participant_->writer(topic, type, qos, user_data, std::move(on_match));
  if (!writer) return tl::unexpected(writer.error());
  return listed(std::move(*writer), true, discovery_);
}

Expected<std::shared_ptr<Reader>> Node::dds_reader(const std::string& topic,
                                                   const std::string& type, const Qos& qos,
                                                   std::function<void(Sample&&)> on_sample,
                                                   const std::string& user_data) {
  auto reader = participant_->reader(topic, type, qos, std::move(on_sample), user_data);
  if (!reader) return tl::unexpected(reader.error());
  return listed(std::move(*reader), false, discovery_);
}

Expected<std::shared_ptr<Writer>> Node::topic_writer(const std::string& topic,
                                                     const std::string& type, const Qos& qos) {
  const auto name = dds_name("rt", topic);
  if (!name) return tl::unexpected(name.error());
  return dds_writer(*name, type, qos, kUserData);
}

Expected<std::shared_ptr<Reader>> Node::topic_reader(const std::string& topic,
                                                     const std::string& type, const Qos& qos,
                                                     std::function<void(Sample&&)> on_sample) {
  const auto name = dds_name("rt", topic);
  if (!name) return tl::unexpected(name.error());
  return dds_reader(*name, type, qos, std::move(on_sample), kUserData);
}

std::vector<Endpoint> Node::publishers_of(const std::string& topic) const {
  return of_topic(*participant_, "rt" + resolve(topic), true);
}

std::vector<Endpoint> Node::subscribers_of(const std::string& topic) const {
  return of_topic(*participant_, "rt" + resolve(topic), false);
}

Rmw Node::rmw_of(const Guid& endpoint) const {
  return participant_->rmw_of(participant_of(endpoint));
}

std::int64_t Node::malformed() const { return malformed_ + participant_->dropped(); }

}  // namespace canopeer::ros
