#include "canopeer/ros2/presence/presence.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <string_view>
#include <thread>

#include "canopeer/cdr/messages/action_types.h"
#include "canopeer/cdr/messages/control_msgs.h"

namespace canopeer::ros {
namespace {

constexpr std::string_view kRequests = "rq";
constexpr std::string_view kSendGoal = "/_action/send_goalRequest";

std::string joined(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// "rq/arm/follow/_action/send_goalRequest" → "/arm/follow"; empty: no such name.
std::string action_of(const std::string& topic) {
  if (!topic.starts_with(kRequests) || !topic.ends_with(kSendGoal)) return {};
  return topic.substr(kRequests.size(), topic.size() - kRequests.size() - kSendGoal.size());
}

}  // namespace

std::string missing_topic(const Node& node, const std::string& topic, const std::string& ros_type) {
  const std::string wanted = dds_type_name(ros_type);
  std::set<std::string> others;
  for (const Endpoint& publisher : node.publishers_of(topic)) {
    if (publisher.type == wanted) return {};
    others.insert(publisher.type);
  }
  const std::string name = node.resolve(topic) + " (" + ros_type + "): ";
  if (others.empty()) return name + "nobody publishes it";
  return name + "it is published as " + joined(others);
}

std::string missing_trajectory_action(Node& node, const std::string& action) {
  using Follow = control_msgs::FollowJointTrajectory;
  const std::string type = dds_request_type<SendGoal<Follow>>();
  std::set<std::string> others;
  for (const Endpoint& endpoint : node.participant().endpoints()) {
    if (endpoint.writer || endpoint.type != type) continue;
    if (const std::string name = action_of(endpoint.topic); !name.empty()) others.insert(name);
  }
  const std::string name = node.resolve(action);
  const std::string text = name + " (" + std::string(Follow::kType) + "): ";
  if (others.contains(name)) return text + "it is not complete yet";
  if (others.empty()) return text + "nobody serves such an action";
  return text + "there is " + joined(others) + " in its place";
}

std::string who_is_there(Node& node) {
  const std::string domain =
      "domain " + std::to_string(node.options().participant.domain) +
      (node.options().participant.interfaces.empty() ? ", loopback only" : "");
  const auto peers = node.participant().peers();
  if (peers.empty()) {
    return "nobody else is in " + domain +
           " (ros2.domain or ROS_DOMAIN_ID; ros2.interfaces for a robot on the network)";
  }
  std::set<std::string> vendors;
  for (const Peer& peer : peers) vendors.insert(peer.vendor_name());
  return std::to_string(peers.size()) + " others are in " + domain + " (" + joined(vendors) + ")";
}

std::vector<std::string> wait_for_presence(const std::function<std::vector<std::string>()>& missing,
                                           double patience_s,
                                           const std::function<bool()>& give_up) {
  using Steady = std::chrono::steady_clock;
  const auto end = Steady::now() + std::chrono::duration<double>(patience_s);
  while (true) {
    auto still = missing();
    if (still.empty() || Steady::now() > end || (give_up && give_up())) return still;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace canopeer::ros
