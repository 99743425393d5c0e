#pragma once

#include <map>
#include <string>

#include "canopeer/base/expected.h"

// Names of nodes, topics and services as ROS 2 has them
// (design.ros2.org/articles/topic_and_service_names.html).

namespace canopeer::ros {

/// Letters, digits and underscores, no digit in front.
[[nodiscard]] Expected<void> check_node_name(const std::string& name);
/// "/", or "/a/b".
[[nodiscard]] Expected<void> check_namespace(const std::string& ns);

/// Whether a joint or frame may be called so: not empty, no longer than 256 octets.
[[nodiscard]] bool is_short_name(const std::string& name);

/// A node's name for others to be told apart by: namespace and name.
struct NodeName {
  std::string ns = "/";
  std::string name;
  [[nodiscard]] std::string full() const;
};

/// "joint_states" → "/ns/joint_states", "~/start" → "/ns/node/start", "{node}/x" → "/ns/node/x".
/// The error says what ROS would not accept.
[[nodiscard]] Expected<std::string> expand_name(const std::string& name, const NodeName& node);

/// The expanded name, or what the first rule whose left side expands to it says.
[[nodiscard]] Expected<std::string> resolve_name(const std::string& name, const NodeName& node,
                                                 const std::map<std::string, std::string>& remaps);

}  // namespace canopeer::ros
