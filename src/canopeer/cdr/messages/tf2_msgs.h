#pragma once

#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/geometry_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::tf2_msgs {

struct TFMessage {
  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  static constexpr std::size_t kMostOctets = 1u << 20;
  std::vector<geometry_msgs::TransformStamped> transforms;
  template <class Archive>
  void visit(Archive& archive) {
    archive(transforms);
  }
};

}  // namespace canopeer::ros::tf2_msgs
