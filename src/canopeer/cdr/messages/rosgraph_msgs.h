#pragma once

#include <string_view>

#include "canopeer/cdr/messages/builtin_interfaces.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::rosgraph_msgs {

struct Clock {
  static constexpr std::string_view kType = "rosgraph_msgs/msg/Clock";
  static constexpr std::size_t kMostOctets = 1u << 20;
  builtin_interfaces::Time clock;
  template <class Archive>
  void visit(Archive& archive) {
    archive(clock);
  }
};

}  // namespace canopeer::ros::rosgraph_msgs
