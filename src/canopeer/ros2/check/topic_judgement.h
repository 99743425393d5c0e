#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/dds/node.h"
#include "canopeer/ros2/check/findings.h"

namespace canopeer::ros {

/// A topic that is listened to, and what came.
struct ListenedTopic {
  std::string what;       ///< "depth"
  std::string key;        ///< of the settings: "ros2.camera.depth"
  std::string topic;      ///< ROS name
  std::string type;       ///< "sensor_msgs/msg/Image"
  bool reliable = false;  ///< asked for
  std::int64_t count = 0;
  std::string encoding;
  std::size_t octets = 0;  ///< of one message
};

/// The kernel's receive buffers of a socket, octets.
struct ReceiveBuffers {
  std::size_t usual = 0;    ///< net.core.rmem_default
  std::size_t largest = 0;  ///< net.core.rmem_max
};
/// Nothing: the files in `folder` cannot be read.
[[nodiscard]] std::optional<ReceiveBuffers> receive_buffers(
    const std::filesystem::path& folder = "/proc/sys/net/core");

/// Holds a topic against who publishes it (`publishers`) and what else there is of its type
/// (`others`).
void judge_topic(const ListenedTopic& topic, const std::vector<Endpoint>& publishers,
                 const std::vector<std::string>& others, double listened_s, Findings& findings);

/// Whether images that are not sent again fit the buffers.
void judge_buffers(const std::vector<ListenedTopic>& topics, const ReceiveBuffers& buffers,
                   Findings& findings);

/// ROS names of topics of that type that somebody publishes.
[[nodiscard]] std::vector<std::string> topics_of_type(const std::vector<Endpoint>& endpoints,
                                                      const std::string& ros_type);

}  // namespace canopeer::ros
