#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "canopeer/dds/node.h"
#include "canopeer/ros2/check/findings.h"

namespace canopeer::ros {

/// Who is in the domain, a line for each participant: vendor, ROS middleware, nodes.
void judge_peers(const std::vector<Peer>& peers,
                 const std::map<ParticipantId, std::set<std::string>>& nodes,
                 const NodeOptions& ours, Findings& findings);

/// Whether the action's servers (`peers` who have one of `endpoints`) are understood.
void judge_action_servers(const std::string& action, const std::vector<Peer>& peers,
                          const std::vector<Endpoint>& endpoints, Findings& findings);

}  // namespace canopeer::ros
