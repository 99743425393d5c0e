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

}  // namespace canopeer::ros
