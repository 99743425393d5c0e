#pragma once

#include "canopeer/config/ros2_settings.h"
#include "canopeer/dds/node.h"

namespace canopeer {

/// The node that settings of ROS 2 describe: its names, remapping, domain and network.
[[nodiscard]] inline ros::NodeOptions node_of(const Ros2Settings& settings) {
  ros::NodeOptions node;
  node.name = settings.node;
  node.ns = settings.ns;
  node.remaps = settings.remaps;
  node.participant.name = settings.node;
  node.participant.domain = settings.domain.value_or(0);
  node.participant.interfaces = settings.interfaces;
  node.participant.peers = settings.peers;
  node.participant.shared_memory = settings.shared_memory;
  return node;
}

}  // namespace canopeer
