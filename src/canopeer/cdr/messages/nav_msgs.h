#pragma once

#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/geometry_msgs.h"
#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::nav_msgs {

struct Path {
  static constexpr std::string_view kType = "nav_msgs/msg/Path";
  std_msgs::Header header;
  std::vector<geometry_msgs::PoseStamped> poses;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, poses);
  }
};

}  // namespace canopeer::ros::nav_msgs
