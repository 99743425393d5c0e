#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/std_msgs.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::octomap_msgs {

/// `data`: what follows the header in a .bt (`binary`) or .ot file; `id`: the class, "OcTree".
struct Octomap {
  static constexpr std::string_view kType = "octomap_msgs/msg/Octomap";
  std_msgs::Header header;
  bool binary{};
  std::string id;
  double resolution{};
  std::vector<std::int8_t> data;
  template <class Archive>
  void visit(Archive& archive) {
    archive(header, binary, id, resolution, data);
  }
};

}  // namespace canopeer::ros::octomap_msgs
