#include "canopeer/ros2/check/peer_judgement.h"

namespace canopeer::ros {
namespace {

std::string network_text(const NodeOptions& ours) {
  std::string text = "domain " + std::to_string(ours.participant.domain);
  if (ours.participant.interfaces.empty()) return text + ", loopback only";
  for (const std::string& address : ours.participant.interfaces) {
    text += ", " + (address == "any" ? std::string("all networks") : address);
  }
  return text;
}

std::string_view middleware_of(Rmw rmw) {
  switch (rmw) {
    case Rmw::fastrtps:
      return "rmw_fastrtps";
    case Rmw::cyclonedds:
      return "rmw_cyclonedds";
    default:
      return "an unknown middleware";
  }
}

}  // namespace

void judge_peers(const std::vector<Peer>& peers,
                 const std::map<ParticipantId, std::set<std::string>>& nodes,
                 const NodeOptions& ours, Findings& findings) {
  findings.ok("network", network_text(ours) + ", " + dds_library());
  if (peers.empty()) {
    findings.wrong(
        "peers",
        "nobody else is there: start the robot's drivers; are domain (ROS_DOMAIN_ID), network "
        "(ros2.interfaces, ros2.peers) and firewall right? Drivers under rmw_zenoh are not heard: "
        "start them with RMW_IMPLEMENTATION=rmw_fastrtps_cpp or rmw_cyclonedds_cpp");
    return;
  }
  for (const Peer& peer : peers) {
    std::string text = peer.vendor_name() + " (" + std::string(middleware_of(peer.rmw())) + ")";
    const auto named = nodes.find(peer.id);
    if (named == nodes.end() || named->second.empty()) {
      text += peer.name.empty() ? ", names no nodes" : ", '" + peer.name + "', names no nodes";
    } else {
      text += ":";
      for (const std::string& node : named->second) text += " " + node;
    }
    if (peer.rmw() == Rmw::unknown) {
      findings.notice("peer", text + "; its services and actions may not understand us");
    } else {
      findings.ok("peer", text);
    }
  }
}

void judge_action_servers(const std::string& action, const std::vector<Peer>& peers,
                          const std::vector<Endpoint>& endpoints, Findings& findings) {
  const std::string requests = "rq" + action + "/_action/send_goalRequest";
  for (const Endpoint& endpoint : endpoints) {
    if (endpoint.writer || endpoint.topic != requests) continue;
    for (const Peer& peer : peers) {
      if (peer.id != participant_of(endpoint.guid) || peer.rmw() != Rmw::unknown) continue;
      findings.wrong("arm", action + " is served by a peer on " + peer.vendor_name() +
                                ", whose actions are not understood: start it with "
                                "RMW_IMPLEMENTATION=rmw_fastrtps_cpp or rmw_cyclonedds_cpp");
    }
  }
}

}  // namespace canopeer::ros
