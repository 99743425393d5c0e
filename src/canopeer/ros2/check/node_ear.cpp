#include "canopeer/ros2/check/node_ear.h"

#include "canopeer/cdr/cdr.h"
#include "canopeer/cdr/messages/rmw_dds_common.h"

namespace canopeer::ros {
namespace {

using namespace rmw_dds_common;

/// Nothing: it is another layout.
template <std::size_t N>
std::optional<std::set<std::string>> names_if(const Payload& payload) {
  try {
    CdrReader reader(payload);
    ParticipantEntitiesInfo<N> info;
    reader(info);
    constexpr std::size_t kPadding = 4;
    if (reader.left() >= kPadding) return std::nullopt;
    std::set<std::string> names;
    for (const auto& node : info.node_entities_info_seq) {
      if (node.node_namespace.empty() || node.node_namespace.front() != '/') return std::nullopt;
      names.insert((node.node_namespace == "/" ? "" : node.node_namespace) + "/" + node.node_name);
    }
    return names;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::set<std::string> node_names_in(const Payload& payload) {
  if (auto names = names_if<kIronGid>(payload)) return *names;
  return names_if<kHumbleGid>(payload).value_or(std::set<std::string>());
}

Expected<void> NodeEar::listen(Node& node) {
  constexpr Qos kInfoQos{true, true, 100};
  auto reader = node.participant().reader("ros_discovery_info",
                                          dds_type_name(ParticipantEntitiesInfo<kIronGid>::kType),
                                          kInfoQos, [this](Sample&& sample) { take(sample); });
  if (!reader) return tl::unexpected(reader.error());
  reader_ = std::move(*reader);
  return {};
}

void NodeEar::take(const Sample& sample) {
  const std::lock_guard lock(mutex_);
  nodes_[participant_of(sample.identity.writer)] = node_names_in(sample.payload);
}

std::map<ParticipantId, std::set<std::string>> NodeEar::nodes() const {
  const std::lock_guard lock(mutex_);
  return nodes_;
}

}  // namespace canopeer::ros
