#pragma once

#include <functional>
#include <string>
#include <vector>

#include "canopeer/dds/node.h"

namespace canopeer::ros {

/// "/joint_states (sensor_msgs/msg/JointState): nobody publishes it", or of another type than
/// wanted; empty: somebody does.
[[nodiscard]] std::string missing_topic(const Node& node, const std::string& topic,
                                        const std::string& ros_type);

/// "/arm/follow_joint_trajectory (control_msgs/action/FollowJointTrajectory): nobody serves it",
/// and which actions of that type there are.
[[nodiscard]] std::string missing_trajectory_action(Node& node, const std::string& action);

/// Who is in the domain, or what keeps us from hearing anybody.
[[nodiscard]] std::string who_is_there(Node& node);

/// Asks `missing` again and again until it has nothing to say, `patience_s` is over or `give_up`
/// is. The last answer.
[[nodiscard]] std::vector<std::string> wait_for_presence(
    const std::function<std::vector<std::string>()>& missing, double patience_s,
    const std::function<bool()>& give_up);

}  // namespace canopeer::ros
